#pragma once
/// Reads the fields of transmission/arm_fields.h from the elements and attributes that are named after them. All throw
/// InputError, as XmlElement does, for an attribute that names no field, one that is missing, or a value beyond its
/// field's bound.

#include "model/xml_reader.h"
#include "transmission/arm_parameters.h"

namespace halyard {

/// Gravity, from an element's text, and what else of the arm is not of its joints.
void read_arm_fields(const XmlElement& arm, ArmParameters<double>& nominal);

/// The fields of the part of a joint that the element is named after; the joint's type and drive are read before.
void read_fields(const XmlElement& element, JointParameters<double>& joint);

/// The part <encoders>: a resolution may be given in counts of a turn, and an offset be unknown.
void read_encoders(const XmlElement& encoders, JointParameters<double>& joint);

}  // namespace halyard

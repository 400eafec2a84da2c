#pragma once
/// Reads the fields of transmission/arm_fields.h from the elements and attributes of the same names. All functions
/// throw InputError, as XmlElement does, for an attribute that names no field, a missing attribute, or a value outside
/// its field's bound.

#include "model/xml/xml_reader.h"
#include "transmission/arm_parameters.h"

namespace halyard {

/// Reads gravity, from an element's text, and the other fields of the arm that belong to no joint.
void read_arm_fields(const XmlElement& arm, ArmParameters<double>& nominal);

/// Reads the fields of one part of a joint; the element has the part's name. The joint's type and drive must be set
/// before.
void read_fields(const XmlElement& element, JointParameters<double>& joint);

/// Reads the part <encoders>. A resolution may be given in counts per turn, and an offset may be "unknown".
void read_encoders(const XmlElement& encoders, JointParameters<double>& joint);

}  // namespace halyard

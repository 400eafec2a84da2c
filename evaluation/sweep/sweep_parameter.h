#pragma once

#include <string>
#include <vector>

#include "model/arm_model.h"

namespace halyard {

/// The parameter of a model with this key:
///
///   joint2.cable.stiffness             one of named_parameters()
///   joint2.encoders.joint_resolution   a number of the encoders, which no diagnosis refits
///   joint2.controller.kp               a gain of the controller, or its torque_limit
///   joint2.effect.backlash.half_gap    a parameter of an effect of a joint
///   arm.effect.payload.mass            a parameter of an effect of the whole arm
///
/// An effect that the model lacks is added first. If the key is one of its sizes, its other sizes are neutral; else
/// they have typical values.
/// Throws InputError for an unknown key. The message lists the known keys, but has no file and line.
ArmNumber model_parameter(ArmModel& model, const std::string& key);

/// SI unit of the parameter, empty for a pure number; throws as model_parameter() does.
std::string parameter_unit(ArmModel model, const std::string& key);

}  // namespace halyard

#pragma once

#include <string>
#include <vector>

#include "model/arm_model.h"

namespace halyard {

/// The number of a model that a key names:
///
///   joint2.cable.stiffness             one of named_parameters()
///   joint2.effect.backlash.half_gap    a parameter of an effect of a joint
///   arm.effect.payload.mass            a parameter of an effect of the whole arm
///
/// An effect that the model lacks is placed first, its other parameters at their typical values.
/// Throws InputError, without a place, for a key that names nothing in this model; it lists what there is.
double& model_parameter(ArmModel& model, const std::string& key);

/// SI unit of what the key names, empty for a pure number; throws as model_parameter().
std::string parameter_unit(ArmModel model, const std::string& key);

}  // namespace halyard

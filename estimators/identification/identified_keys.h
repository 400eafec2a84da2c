#pragma once
/// Turns the user's list of parameters to identify into keys.

#include <string>
#include <vector>

#include "model/arm_model.h"

namespace halyard {

/// Turns text such as "coupling,stiffness,joint2.cable.damping" into keys of named_parameters(), each once, in the
/// model's order. An item is a key or one of the groups coupling, stiffness, damping, tension, motor_friction and
/// joint_friction. A group leaves out parameters that are 0 in the model; give their keys instead. Throws InputError
/// for an unknown group or key, or for a parameter that is in no equation of the model.
std::vector<std::string> identified_keys(const ArmModel& model, const std::string& text);

/// True if the parameter is in an equation of the model. For example, the cable law of the paper's Eq. 6 contains no
/// tension.
bool is_in_equations(const ArmModel& model, const ParameterInfo& info);

}  // namespace halyard

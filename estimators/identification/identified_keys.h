#pragma once
/// Which numbers of an arm are to be identified, from what a user writes.

#include <string>
#include <vector>

#include "model/arm_model.h"

namespace halyard {

/// "coupling,stiffness,joint2.cable.damping" as keys of named_parameters(), each once, in the model's order. A word
/// stands for a kind: coupling, stiffness, damping, tension, motor_friction, joint_friction; couplings and other
/// numbers that are 0 in the model are none of a kind, and can be named by their key. Throws InputError for a word or
/// key that names nothing in this model, or a number that no equation of it holds.
std::vector<std::string> identified_keys(const ArmModel& model, const std::string& text);

/// Whether an equation of the model holds the number. The cable law of the paper's Eq. 6 takes no tension.
bool is_in_equations(const ArmModel& model, const ParameterInfo& info);

}  // namespace halyard

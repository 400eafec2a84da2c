#pragma once
/// What a residual that no candidate explains looks like.

#include "diagnosis/evidence.h"

namespace halyard {

/// One sentence for joint k (0-based): the size of the rest of its position and its motor's torque on the training
/// records, and the view that tells most of each (views.h).
std::string signature(const Evidence& evidence, const Hypothesis& hypothesis, int joint);

/// True if joint k moves along one sine, or stands still, in the one record there is: such a motion cannot tell effects
/// of the joint apart. What counts is the joint's own motion: its motor also makes up for the inboard joints.
bool is_one_sinusoid(const std::vector<Record>& records, const ArmParameters<double>& arm, int joint);

}  // namespace halyard

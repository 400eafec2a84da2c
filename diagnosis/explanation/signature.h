#pragma once
/// Description of a residual that no candidate explains.

#include "diagnosis/fit/evidence.h"

namespace halyard {

/// One sentence for a 0-based joint: the size of its position and motor torque residuals on the training records, also
/// over the floor of the channel, and the most informative view of each (views.h).
std::string signature(const Evidence& evidence, const Hypothesis& hypothesis, int joint);

/// True if the motor hardly ever turns fast enough for its friction to have a direction.
bool stands_still(const Record& record, const ArmParameters<double>& arm, int joint);

/// True if there is one record only and the joint moves along one sine or stands still in it. Such a motion cannot tell
/// effects of the joint apart. The test uses the joint's own motion, because its motor also moves with inboard joints.
bool is_one_sinusoid(const std::vector<Record>& records, const ArmParameters<double>& arm, int joint);

}  // namespace halyard

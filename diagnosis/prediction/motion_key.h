#pragma once
/// Which hypotheses move alike, so that their motion is integrated once.

#include "diagnosis/prediction/prediction.h"

namespace halyard {

/// Everything that the motion of the joints depends on if the motors move as they were measured: not what acts between
/// the command and the rotor, unless an effect's states carry it on, nor what a joint's sensor adds. Compare keys of
/// hypotheses with the same effects.
std::vector<double> motion_key(const Hypothesis& h, const Record& record);

}  // namespace halyard

#pragma once
/// What an update of each estimator costs, and how the cost grows with the number of joints and with effects.

#include "bench/performance/turns.h"

namespace halyard {

/// All estimators on the RAVEN-II (12 states), then `ekf` and `sr_ukf` with three effects of its model: friction of
/// motor 1, torque ripple of motor 2, and backlash of joint 3.
std::vector<StepTime> time_estimators(int rounds);

/// `ekf` and `sr_ukf` on chains of 1 to 7 joints, in turn.
std::vector<StepTime> time_chains(int rounds);

}  // namespace halyard

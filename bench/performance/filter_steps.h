#pragma once
/// Times of one step of the filters on the RAVEN-II (12 states), with their variants.

#include "bench/performance/turns.h"

namespace halyard {

/// `update` of ekf and sr_ukf, with the exponential step and with sub-steps; then prediction and correction of sr_ukf
/// alone with sub-steps, sigma points in lanes and one by one in scalar code.
std::vector<StepTime> time_filters(int rounds);

}  // namespace halyard

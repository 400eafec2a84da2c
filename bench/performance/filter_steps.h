#pragma once
/// Times of one step of the filters on the RAVEN-II (12 states), measured in turns: a block of each variant after the
/// other, so that all of them meet the same state of the machine.

#include <string>
#include <vector>

namespace halyard {

struct StepTime {
  std::string variant;
  double median_us = 0, p99_us = 0;
};

/// `update` of ekf and sr_ukf, with the exponential step and with sub-steps; then prediction and correction of sr_ukf
/// alone with sub-steps, sigma points in lanes and one by one in scalar code.
std::vector<StepTime> time_filters(int rounds);

}  // namespace halyard

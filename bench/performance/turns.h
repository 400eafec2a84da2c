#pragma once
/// Times of the steps of several filters, measured in turns: a block of each variant after the other, so that all of
/// them meet the same state of the machine.

#include <functional>
#include <string>
#include <vector>

#include "estimators/estimator.h"
#include "model/arm_model.h"

namespace halyard {

struct StepTime {
  std::string variant;
  double mean_us = 0;  ///< of 100 steps: the median of such means
  double median_us = 0, p99_us = 0;
};

/// A variant: what one sample costs. Sample 0 starts anew.
struct Variant {
  std::string name;
  std::function<void(std::size_t)> step;
};

/// Of each variant, over `rounds` rounds of `samples` samples.
std::vector<StepTime> time_in_turns(const std::vector<Variant>& variants, std::size_t samples, int rounds);

/// Two seconds of sines of all joints at 1 kHz, seen by a camera at 30 Hz; `model` without noise.
std::vector<Sample> recorded(const ArmModel& model);

}  // namespace halyard

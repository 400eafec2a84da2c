#pragma once
/// The page docs/performance.md.

#include <string>
#include <vector>

#include "bench/performance/diagram.h"
#include "bench/performance/plant_speed.h"
#include "bench/performance/turns.h"

namespace halyard {

/// What one run has measured.
struct Measured {
  std::vector<StepTime> estimators, chains, variants;  ///< of filter_costs.h and filter_steps.h
  std::vector<PlantSpeed> plant;
  std::vector<Panel> moving, resting;
};

std::string page(const Measured& m);

}  // namespace halyard

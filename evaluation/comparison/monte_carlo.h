#pragma once
/// The same comparison over many seeds.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/judgement/consistency.h"
#include "evaluation/judgement/error_statistics.h"
#include "model/arm_model.h"
#include "plant/scenario.h"

namespace halyard {

/// The noise that filters with the model's own rule (estimators/process/noise.h) assume, as a simulation can draw it: torques
/// and joint forces with the spectral density 2 σ² τ, held over a tick, and the encoders' deviation in place of their
/// rounding.
TickNoise assumed_noise(const ArmModel& model, double tick_s);

/// One estimator over all runs.
struct RunsOfEstimator {
  std::string name;
  long failures = 0;  ///< runs that it did not end
  std::string first_failure;
  std::vector<ErrorStatistics> errors;       ///< [joint] root of the mean of the runs' squares, mean of their others
  std::vector<double> rms_lower, rms_upper;  ///< [joint] 2.5 and 97.5 percentiles of the runs' own
  Consistency nis;
  std::vector<Consistency> nees;  ///< [joint]
  /// [joint] share of instants whose mean NEES over the runs lies in the band of χ²(runs) / runs.
  std::vector<double> in_band;
  std::vector<PairedRatio> against_kinematics;  ///< [joint]; NaN without that estimator or for itself
};

struct MonteCarlo {
  int runs = 0;
  /// The noise that the scenario was disturbed by, in multiples of what the filters assume; none: the scenario's own.
  /// The caller's to fill.
  std::optional<double> noise;
  std::vector<RunsOfEstimator> estimators;
};

struct MonteCarloOptions {
  int runs = 1;
  double skip_s = 0.5;
  std::function<void(double)> run_done = {};  ///< called with 1 for each run, from any thread
};

/// Simulates the scenario with the seeds seed, seed + 1, ..., on all cores, and runs all estimators over each. The
/// result does not depend on the number of threads. An estimator that fails on a run is counted, and left out of that
/// run. Throws what simulate and make_estimator throw.
MonteCarlo run_monte_carlo(const Scenario& scenario, const ArmModel& model, const std::vector<std::string>& estimators,
                           const MonteCarloOptions& options);

}  // namespace halyard

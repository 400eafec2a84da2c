#pragma once
/// Comparison of estimators over many seeds of a scenario.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/judgement/consistency.h"
#include "evaluation/judgement/error_statistics.h"
#include "evaluation/run/contained_run.h"
#include "model/arm_model.h"
#include "plant/scenario.h"

namespace halyard {

/// One estimator over all runs.
struct RunsOfEstimator {
  std::string name;
  long failures = 0;  ///< runs in which it failed
  std::string first_failure;
  /// [joint] rms: root of the mean square over all runs; other statistics: means of the runs' values
  std::vector<ErrorStatistics> errors;
  std::vector<double> rms_lower, rms_upper;  ///< [joint] 2.5 and 97.5 percentiles of the runs' RMS errors
  Consistency nis;
  std::vector<Consistency> nees;  ///< [joint]
  /// [joint] share of instants at which the mean NEES over the runs lies in the 95 % band of χ²(runs) / runs.
  std::vector<double> in_band;
  std::vector<PairedRatio> against_kinematics;  ///< [joint]; NaN for kinematics itself, or without it
};

struct MonteCarlo {
  int runs = 0;
  /// Noise added to the simulation, in multiples of the filters' assumed noise; none: the scenario's own noise.
  /// The caller fills it.
  std::optional<double> noise;
  std::vector<RunsOfEstimator> estimators;
};

struct MonteCarloOptions {
  int runs = 1;
  double skip_s = 0.5;
  ContainmentOptions containment = {};
  std::function<void(double)> run_done = {};  ///< called with 1 for each run, from any thread
};

/// Simulates the scenario with the seeds seed, seed + 1, ..., on all cores, and runs all estimators over each log. The
/// result does not depend on the number of threads. A failure of an estimator is counted, and the run is left out of
/// its statistics. Throws as simulate and make_estimator do; if runs throw, what the first of them throws, with its
/// seed in the message.
MonteCarlo run_monte_carlo(const Scenario& scenario, const ArmModel& model, const std::vector<std::string>& estimators,
                           const MonteCarloOptions& options);

}  // namespace halyard

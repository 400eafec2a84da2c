#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "estimators/estimator.h"
#include "model/log.h"

namespace halyard {

/// What an estimator said of a log, sample by sample.
struct EstimatorRun {
  std::string name;
  Log estimates;               ///< time of the log, joint_position, joint_velocity; NaN before the start
  Signals joint_position_std;  ///< [n] one standard deviation; 0 where the estimator has none
  std::vector<std::string> extra_output_names;  ///< what else it estimates of every joint
  std::vector<Signals> extra_outputs;           ///< [name][n]; NaN: nothing of that joint
  EstimatorReport report;
  std::vector<double> nis;           ///< νᵀ S⁻¹ ν over the motors measured, ~ 1 if the model is right; NaN: none
  Signals innovation;                ///< [n] S_root⁻¹ ν, ~ N(0, 1) each if the model is right; NaN: none
  double microseconds_per_step = 0;  ///< wall time: differs from run to run
  std::string failure;               ///< why there is no estimate; empty: there is
};

/// Mean of what is not NaN; NaN without any.
double mean_of(const std::vector<double>& values);

struct EstimateOptions {
  /// Hands the log's measured external loads to the estimator. Otherwise it gets motor signals alone.
  bool use_joint_torque = false;
  /// Called about a hundred times a run, with the fraction done.
  std::function<void(double)> progress = {};
  /// Called after each sample with its row of the log.
  std::function<void(std::size_t)> row_done = {};
};

/// A run without any estimate: all NaN.
EstimatorRun no_run(const std::string& name, const Log& log);

/// Runs the estimator over all samples of the log: motor torque and position, and what the options add. It starts at
/// the first sample that has the position of every motor. An estimate that the estimator revises takes the place of
/// what it said at that sample.
///
/// Throws InputError if no sample has, std::runtime_error, naming estimator and time, if the estimator fails, gives
/// an estimate that is not finite, or revises one of an instant that is no sample's.
EstimatorRun run_estimator(Estimator& estimator, const std::string& name, const Log& log,
                           const EstimateOptions& options = {});

/// Writes time, joint_position_k, joint_velocity_k, joint_position_std_k and the extra outputs as CSV; whole or absent.
void write_estimates(const std::filesystem::path& path, const EstimatorRun& run, const std::string& comment = "");

}  // namespace halyard

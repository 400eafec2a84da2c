#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "estimators/estimator.h"
#include "model/input_error.h"
#include "model/log.h"

namespace halyard {

/// An estimator refuses a log: HALYARD_REFUSED, or an InputError of its functions. The message names estimator, log and
/// time.
class EstimatorRefusal : public InputError {
 public:
  using InputError::InputError;
};

/// The results of an estimator on a log, sample by sample.
struct EstimatorRun {
  std::string name;
  Log estimates;               ///< time of the log, joint_position, joint_velocity; NaN before the start
  Signals joint_position_std;  ///< [n] one standard deviation; 0 where the estimator has none
  std::vector<std::string> extra_output_names;  ///< Estimator::extra_output_names()
  std::vector<Signals> extra_outputs;           ///< [name][n]; NaN: not estimated for that joint
  EstimatorReport report;
  std::vector<double> nis;           ///< νᵀ S⁻¹ ν / m of m motors measured, ~ 1 if the model is right; NaN: none
  Signals innovation;                ///< [n] S_root⁻¹ ν, ~ N(0, 1) each if the model is right; NaN: none
  double microseconds_per_step = 0;  ///< wall time: differs from run to run
  std::string failure;               ///< why there is no estimate; empty: no failure
  bool refused = false;              ///< because of the log, not of the estimator
};

/// Mean of the values that are not NaN; NaN if there are none.
double mean_of(const std::vector<double>& values);

struct EstimateOptions {
  /// Passes the log's measured external loads to the estimator. Otherwise it gets motor signals alone.
  bool use_joint_torque = false;
  /// Called about a hundred times a run, with the fraction done.
  std::function<void(double)> progress = {};
  /// Called after each sample with its row of the log.
  std::function<void(std::size_t)> row_done = {};
};

/// A run without estimates: all are NaN.
EstimatorRun no_run(const std::string& name, const Log& log);

/// Runs the estimator over all samples of the log. It gets motor torque and position, and external loads if the options
/// ask for it. It starts at the first sample at which every motor has been read within the last 0.1 s; the first sample
/// has the last readings. A revised estimate replaces the earlier one of that sample.
///
/// Throws InputError if there is no such sample, EstimatorRefusal, or std::runtime_error, naming
/// estimator and time, if the estimator fails, if an estimate is not finite, or if a revision's time is no sample's.
EstimatorRun run_estimator(Estimator& estimator, const std::string& name, const Log& log,
                           const EstimateOptions& options = {});

/// Writes time, joint_position_k, joint_velocity_k, joint_position_std_k and the extra outputs as CSV. After a failure
/// there is no partial file.
void write_estimates(const std::filesystem::path& path, const EstimatorRun& run, const std::string& comment = "");

}  // namespace halyard

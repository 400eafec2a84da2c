#pragma once

#include <string>
#include <vector>

#include "evaluation/run/estimate.h"
#include "model/arm_model.h"

namespace halyard {

/// Estimators that are not trusted run in a process of their own, the program halyard_worker, so that one that crashes,
/// or never returns, ends its run and nothing else. The worker knows halyard's own effects and those of modules
/// (load_effects). It does not know an effect that the calling program registered itself (register_effect): a model with
/// such an effect is refused with an InputError, unless the estimator is run in the calling process.
///
/// The worker is found in the installation or build tree of the calling program or of halyard's libraries. A program that
/// links halyard statically and lives elsewhere names it in the environment variable HALYARD_WORKER.
struct ContainmentOptions {
  double step_limit_s = 10;  ///< a step, the making, or a promise put to the test that takes longer is the end
  bool in_process = false;   ///< no containment: a crash ends the calling program, and no time limit holds
};

/// Makes the estimator and runs it over the log as run_estimator does, with the same numbers to the last bit, in a worker.
/// Calls options.progress now and then, and never options.row_done.
/// Throws InputError where the estimator cannot be made (name, module, options), the log cannot be run over, or there is
/// no halyard_worker; std::runtime_error, naming estimator, log and time, where the run fails, crashes, or exceeds the
/// limit.
EstimatorRun run_contained(const std::string& name, const ArmModel& model, const Log& log,
                           const EstimateOptions& options = {}, const ContainmentOptions& containment = {});

/// Makes the estimator in a worker and lets go of it: throws as run_contained does where it cannot be made.
void check_estimator(const std::string& name, const ArmModel& model, const ContainmentOptions& containment = {});

/// Puts the estimator to the tests of plugins/host/conformance.h in a worker; those of a Kalman filter too, if asked.
/// Returns a line for each promise that it breaks; a crash, or a promise that takes longer than the limit, is the last.
/// Throws as run_contained does where it cannot be made.
std::vector<std::string> contained_faults(const std::string& name, const ArmModel& model, bool kalman,
                                          const ContainmentOptions& containment = {});

}  // namespace halyard

#pragma once

#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "evaluation/run/estimate.h"
#include "model/arm_model.h"
#include "plugins/host/loader.h"

namespace halyard {

/// Estimators run in a process of their own, the program halyard_worker, so that a crash or an endless loop ends only
/// that run. The worker knows halyard's own effects and those of modules (load_effects). It does not know effects that
/// the calling program registered itself (register_effect): a model with such an effect is refused with an InputError,
/// unless the estimator runs in the calling process.
///
/// The worker is found in the installation or build tree of the calling program or of halyard's libraries. A program
/// that links halyard statically and is elsewhere gives the worker's path in the environment variable HALYARD_WORKER.
struct ContainmentOptions {
  double step_limit_s = 10;  ///< longest time for construction, for a step, or for one conformance test
  bool in_process = false;   ///< true: run in the calling process, without time limit; a crash ends that process
};

/// Makes the estimator and runs it over the log in a worker. The result equals that of run_estimator bit for bit.
/// Calls options.progress repeatedly, and never options.row_done.
/// Throws InputError if the estimator cannot be made (name, module, options), if no sample of the log has the position
/// of every motor, or if there is no halyard_worker. Throws std::runtime_error, naming estimator, log and time, if the
/// run fails, crashes, is killed, runs out of memory, or exceeds the time limit.
EstimatorRun run_contained(const std::string& name, const ArmModel& model, const Log& log,
                           const EstimateOptions& options = {}, const ContainmentOptions& containment = {});

/// find_plugins() with a worker for each module: one that crashes or hangs as it is opened is refused as others are.
/// Throws InputError if there is no halyard_worker.
std::vector<PluginInfo> contained_plugins(std::vector<std::string>* refused = nullptr,
                                          const ContainmentOptions& containment = {});

/// The name that the module at this path states, as the <estimator> elements of models use it; the name of any other
/// estimator is its own. Throws as contained_plugins() does, InputError for a module that cannot be opened, and
/// std::runtime_error for one that crashes or hangs as it is opened.
std::string stated_name(const std::string& name, const ContainmentOptions& containment = {});

/// True for what is no fault of an estimator: no memory, no process to be had, one that is killed, no worker.
bool is_fault_of_the_machine(const std::exception& error);

/// True for what an estimator is to blame for: a crash, a time limit that it exceeds, a refusal of the log; not for
/// other input that is wrong, nor for a fault of the machine.
bool is_failure_of_the_estimator(const std::exception& error);

/// Checks estimators before many runs: does what may throw. A failure of the estimator's own, such as a crash as it is
/// made, is not thrown: it is left to the runs, which fail one by one.
void leave_failures_to_the_runs(const std::function<void()>& check);

/// Checks that a worker can make the estimator; throws as run_contained does if not.
void check_estimator(const std::string& name, const ArmModel& model, const ContainmentOptions& containment = {});

/// Runs the tests of plugins/host/conformance.h on the estimator in a worker; `kalman`: also those for Kalman filters.
/// Returns a line for each promise that the estimator breaks. A crash, or a test that exceeds the time limit, ends
/// the tests; the result is then a single line that reports it. Throws as run_contained does if the estimator cannot be
/// made.
std::vector<std::string> contained_faults(const std::string& name, const ArmModel& model, bool kalman,
                                          const ContainmentOptions& containment = {});

}  // namespace halyard

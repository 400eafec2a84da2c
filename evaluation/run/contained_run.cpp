#include "evaluation/run/contained_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <new>
#include <set>
#include <system_error>

#include "evaluation/worker/bytes.h"
#include "evaluation/worker/worker_process.h"
#include "model/input_error.h"
#include "model/output/read_files.h"
#include "plugins/host/conformance.h"
#include "plugins/host/effect_module.h"
#include "transmission/effects/library.h"

namespace halyard {
namespace {

/// A worker knows halyard's own effects and those of modules.
void check_effects(const std::string& estimator, const ArmModel& model) {
  static const std::set<std::string> built_in = [] {
    std::set<std::string> names;
    for (const auto& effect : built_in_effects()) names.insert(effect->name());
    return names;
  }();
  for (const PlacedEffect& placed : model.effects) {
    if (built_in.contains(placed.effect->name()) || is_from_module(*placed.effect)) continue;
    throw InputError("estimator " + estimator + ": the process that runs it does not know the effect " +
                     in_quotes(placed.effect->name()) +
                     ", which this program registered itself; put the effect into a module for load_effects(), or run "
                     "the estimator in this process (ContainmentOptions::in_process)");
  }
}

WorkerTask task_of(WorkerJob job, const std::string& estimator, const ArmModel& model) {
  check_effects(estimator, model);
  if (is_module_path(estimator)) note_read(estimator);
  WorkerTask task;
  task.job = job;
  task.estimator = estimator;
  task.model = model;
  for (const auto& path : loaded_effect_modules()) task.effect_modules.push_back(path.string());
  for (const auto& path : plugin_folders()) task.plugin_folders.push_back(path.string());
  return task;
}

std::vector<std::string> faults_in_process(const std::string& name, const ArmModel& model, bool kalman) {
  std::vector<std::string> faults = conformance_faults(name, model);
  if (kalman) std::ranges::copy(kalman_faults(name), std::back_inserter(faults));
  return faults;
}

/// By a worker that opens the module.
PluginInfo described(const std::filesystem::path& path, const ContainmentOptions& containment) {
  WorkerTask task;
  task.job = WorkerJob::describe;
  task.estimator = path.string();
  WorkerWatch watch;
  watch.step_limit_s = containment.step_limit_s;
  watch.place = [&](long, const std::string&) { return "plugin " + path.string() + ": as it is opened"; };
  const std::string answer = result_of_worker(task, watch);
  const std::vector<std::string> texts = ByteReader(answer).texts();
  return {texts.at(0), texts.at(1), path};
}

}  // namespace

EstimatorRun run_contained(const std::string& name, const ArmModel& model, const Log& log,
                           const EstimateOptions& options, const ContainmentOptions& containment) {
  if (containment.in_process) return run_estimator(*make_estimator(name, model), name, log, options);
  WorkerTask task = task_of(WorkerJob::run, name, model);
  task.use_joint_torque = options.use_joint_torque;
  task.log = log;
  WorkerWatch watch;
  watch.step_limit_s = containment.step_limit_s;
  watch.step_done = [&](long rows) {
    if (options.progress) options.progress(double(rows) / double(log.size()));
  };
  watch.place = [&](long rows, const std::string&) {
    if (log.size() == 0) return fmt::format("estimator {} on {}", name, log.source);
    const std::size_t row = std::min(static_cast<std::size_t>(rows), log.size() - 1);
    return fmt::format("estimator {} on {} at {:.12g} s", name, log.source, log.time[row]);
  };
  return estimator_run_of(result_of_worker(task, watch), name, log);
}

std::vector<PluginInfo> contained_plugins(std::vector<std::string>* refused, const ContainmentOptions& containment) {
  if (containment.in_process) return find_plugins(refused);
  worker_program();
  std::exception_ptr no_worker;  // without one, no module is to blame
  std::vector<PluginInfo> found = find_plugins(refused, [&](const std::filesystem::path& path) {
    try {
      return described(path, containment);
    } catch (const WorkerEnded& end) {
      throw InputError(end.what());
    } catch (const NoWorker&) {
      no_worker = std::current_exception();
      throw;
    }
  });
  if (no_worker) std::rethrow_exception(no_worker);
  return found;
}

std::string stated_name(const std::string& name, const ContainmentOptions& containment) {
  if (!is_module_path(name)) return name;
  return containment.in_process ? describe_module(name).name : described(name, containment).name;
}

bool is_fault_of_the_machine(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) || dynamic_cast<const std::system_error*>(&error) ||
         dynamic_cast<const NoWorker*>(&error) || dynamic_cast<const WorkerKilled*>(&error);
}

bool is_failure_of_the_estimator(const std::exception& error) {
  const bool is_wrong_input = dynamic_cast<const InputError*>(&error) && !dynamic_cast<const EstimatorRefusal*>(&error);
  return !is_wrong_input && !is_fault_of_the_machine(error);
}

void leave_failures_to_the_runs(const std::function<void()>& check) {
  try {
    check();
  } catch (const std::exception& error) {
    if (!is_failure_of_the_estimator(error)) throw;
  }
}

void check_estimator(const std::string& name, const ArmModel& model, const ContainmentOptions& containment) {
  if (containment.in_process) {
    make_estimator(name, model);
    return;
  }
  WorkerWatch watch;
  watch.step_limit_s = containment.step_limit_s;
  watch.place = [&](long, const std::string&) { return fmt::format("estimator {}, being made", name); };
  result_of_worker(task_of(WorkerJob::make, name, model), watch);
}

std::vector<std::string> contained_faults(const std::string& name, const ArmModel& model, bool kalman,
                                          const ContainmentOptions& containment) {
  if (containment.in_process) return faults_in_process(name, model, kalman);
  WorkerTask task = task_of(WorkerJob::examine, name, model);
  task.kalman = kalman;
  WorkerWatch watch;
  watch.step_limit_s = containment.step_limit_s;
  watch.place = [](long, const std::string& promise) { return promise; };
  try {
    return ByteReader(result_of_worker(task, watch)).texts();
  } catch (const WorkerEnded& end) {
    return {end.what() + std::string(", the rest was not tried")};
  } catch (const WorkerKilled& end) {
    throw WorkerKilled(name + ": " + end.what());
  }
}

}  // namespace halyard

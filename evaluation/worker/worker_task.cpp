#include "evaluation/worker/worker_task.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "evaluation/worker/bytes.h"
#include "model/input_error.h"
#include "model/model_file.h"
#include "plugins/host/effect_module.h"
#include "plugins/host/loader.h"

namespace halyard {
namespace {

/// Counted up with every change of what is sent.
constexpr std::size_t kWorkerInterface = 5;

/// All that a log measures. The columns that its file had besides are for messages of the caller.
constexpr std::array kSignals = {&Log::motor_torque,   &Log::motor_position, &Log::joint_position,
                                 &Log::joint_velocity, &Log::joint_torque,   &Log::marker};

void write_log(ByteWriter& w, const Log& log) {
  w.count(static_cast<std::size_t>(log.n_joints));
  w.numbers(log.time);
  w.number(log.clock_start);
  w.text(log.source);
  for (const auto signals : kSignals) w.signals(log.*signals);
}

Log read_log(ByteReader& r) {
  Log log(static_cast<int>(r.count()));
  log.time = r.numbers();
  log.clock_start = r.number();
  log.source = r.text();
  for (const auto signals : kSignals) log.*signals = r.signals();
  return log;
}

ArmModel read_model(ByteReader& r, const std::string& estimator) {
  const std::string xml = r.text(), source = r.text();
  try {
    return parse_model(xml, source);
  } catch (const InputError& error) {
    throw InputError((source.empty() ? "" : source + ": ") + "estimator " + estimator + ": " + error.what());
  }
}

Signals columns_of(const Log& log, ByteReader& r) {
  const Signals all = r.signals();
  const auto fits = [&](const std::vector<double>& column) { return column.size() == log.size(); };
  if (all.size() != static_cast<std::size_t>(log.n_joints) || !std::ranges::all_of(all, fits))
    throw std::runtime_error("its process gave a run over another log");
  return all;
}

}  // namespace

std::string worker_task_bytes(const WorkerTask& task) {
  ByteWriter w;
  w.count(kWorkerInterface);
  w.count(static_cast<std::size_t>(task.job));
  w.text(task.estimator);
  w.texts(task.effect_modules);
  w.texts(task.plugin_folders);
  w.text(model_to_xml(task.model));
  w.text(task.model.source);
  w.flag(task.kalman);
  w.flag(task.use_joint_torque);
  write_log(w, task.log);
  return w.take();
}

WorkerTask receive_worker_task(std::string_view bytes) {
  ByteReader r(bytes);
  if (const std::size_t version = r.count(); version != kWorkerInterface)
    throw InputError("halyard_worker: speaks interface " + std::to_string(kWorkerInterface) +
                     ", the program that uses it " + std::to_string(version) +
                     "; install both from one version of halyard");
  WorkerTask task;
  task.job = static_cast<WorkerJob>(r.count());
  task.estimator = r.text();
  task.effect_modules = r.texts();
  for (const std::string& module : task.effect_modules) load_effects(module);
  task.plugin_folders = r.texts();
  search_plugins_only_in({task.plugin_folders.begin(), task.plugin_folders.end()});
  if (task.job == WorkerJob::describe || task.job == WorkerJob::load) return task;  // of no arm
  task.model = read_model(r, task.estimator);
  task.kalman = r.flag();
  task.use_joint_torque = r.flag();
  task.log = read_log(r);
  return task;
}

std::string estimator_run_bytes(const EstimatorRun& run) {
  ByteWriter w;
  w.signals(run.estimates.joint_position);
  w.signals(run.estimates.joint_velocity);
  w.signals(run.joint_position_std);
  w.signals(run.innovation);
  w.numbers(run.nis);
  for (const long n : {run.report.steps, run.report.repaired_factors, run.report.gated})
    w.count(static_cast<std::size_t>(n));
  w.number(run.microseconds_per_step);
  w.texts(run.extra_output_names);
  for (const Signals& output : run.extra_outputs) w.signals(output);
  return w.take();
}

EstimatorRun estimator_run_of(std::string_view bytes, const std::string& name, const Log& log) {
  ByteReader r(bytes);
  EstimatorRun run = no_run(name, log);
  run.estimates.joint_position = columns_of(log, r);
  run.estimates.joint_velocity = columns_of(log, r);
  run.joint_position_std = columns_of(log, r);
  run.innovation = columns_of(log, r);
  run.nis = r.numbers();
  if (run.nis.size() != log.size()) throw std::runtime_error("its process gave a run over another log");
  for (long* n : {&run.report.steps, &run.report.repaired_factors, &run.report.gated})
    *n = static_cast<long>(r.count());
  run.microseconds_per_step = r.number();
  run.extra_output_names = r.texts();
  for (std::size_t i = 0; i < run.extra_output_names.size(); ++i) run.extra_outputs.push_back(columns_of(log, r));
  return run;
}

}  // namespace halyard

#pragma once
/// The task of a worker (worker_main.cpp), and its answer.
///
///   shared memory   WorkerPage, followed by the task: worker_task_bytes()
///   pipe            the answer: one byte of Answer, then the result's bytes or the error's message

#include <atomic>
#include <string>
#include <string_view>
#include <vector>

#include "evaluation/run/estimate.h"
#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

enum class WorkerJob : std::size_t {
  describe,  ///< say what the module is; the result is a list of two texts, name and description
  make,      ///< make and destroy the estimator; the result is empty
  run,       ///< run it over the log; the result is estimator_run_bytes()
  examine,   ///< run the tests of plugins/host/conformance.h on it; the result is a list of texts
  load       ///< load the modules of effects; the result is empty
};

struct WorkerTask {
  WorkerJob job = WorkerJob::make;
  std::string estimator;                    ///< name, or path of a module
  ArmModel model;                           ///< passed as XML, as to every plug-in
  std::vector<std::string> effect_modules;  ///< for load_effects(), in this order
  std::vector<std::string> plugin_folders;  ///< searched for estimators by name
  bool kalman = false;                      ///< for examine: also run the tests for Kalman filters
  bool use_joint_torque = false;            ///< run: EstimateOptions::use_joint_torque
  Log log = {};                             ///< run
};

std::string worker_task_bytes(const WorkerTask& task);
/// Reads the task. Loads its effect modules before the model, which may name their effects. From then on this process
/// looks for estimators in the task's folders. Throws InputError for bytes of another version of halyard, and as
/// load_effects() and parse_model() do.
WorkerTask receive_worker_task(std::string_view bytes);

std::string estimator_run_bytes(const EstimatorRun& run);
/// Reads a run. Throws std::runtime_error if the bytes are truncated or not of a run over this log.
EstimatorRun estimator_run_of(std::string_view bytes, const std::string& name, const Log& log);

/// The first byte of an answer.
enum class Answer : char {
  result = 'R',
  refusal = 'E',
  input_error = 'I',
  failure = 'F',
  no_memory = 'M',
  no_process = 'P'  ///< the estimator's process could not be started; the error's number follows
};

/// Memory shared by both processes: the worker's progress.
struct WorkerPage {
  std::size_t task_size = 0;             ///< bytes
  std::atomic<bool> has_started{false};  ///< the worker's own code runs
  std::atomic<long> steps{0};            ///< rows done, or conformance tests begun
  char promise[64] = "";                 ///< the promise under test
};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<long>::is_always_lock_free);

}  // namespace halyard

#pragma once
/// Starts and watches a worker (worker_main.cpp).
///
/// The worker is a new program, not a fork of this process. A fork of a process with several threads copies the locks
/// that other threads hold, and nothing in the copy would ever release them.

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "evaluation/worker/worker_task.h"
#include "model/input_error.h"

namespace halyard {

/// The worker crashed, ended, or took too long.
class WorkerEnded : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The worker was killed (SIGKILL) within its time, as the system does when memory runs out, or found no memory.
class WorkerKilled : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// There is no worker program, or it cannot be started.
class NoWorker : public InputError {
  using InputError::InputError;
};

/// Path of the worker program: the environment variable HALYARD_WORKER, or else halyard_worker in the installation or
/// build tree of the running program or of halyard's library.
/// Throws NoWorker if there is none.
std::filesystem::path worker_program();

struct WorkerWatch {
  double step_limit_s = 0;  ///< longest time for the start of the program, or for a step
  /// Called repeatedly with the number of steps that the worker has done.
  std::function<void(long)> step_done = [](long) {};
  /// Text for messages: what the worker is doing (which step, or which test). `promise`: the promise under test.
  std::function<std::string(long steps, const std::string& promise)> place;
};

/// Runs the task in a worker and returns the bytes of its result. The worker is killed if this process or the calling
/// thread ends first.
/// If the worker reports an InputError, throws an InputError with its message; if it reports another exception, a
/// std::runtime_error with its message. Throws WorkerEnded or WorkerKilled (`PLACE: what`) if there is no answer, and
/// NoWorker or std::system_error if the worker cannot be started.
std::string result_of_worker(const WorkerTask& task, const WorkerWatch& watch);

}  // namespace halyard

#pragma once
/// A worker (worker_main.cpp) seen from the process that started it.
///
/// A new program is started, and this process is not forked: a fork of a process with several threads has a copy of
/// every lock that another thread held at that moment, and nobody there who would ever release it.

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "evaluation/worker/worker_task.h"

namespace halyard {

/// The worker crashed, ended, or took too long.
class WorkerEnded : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The program that does the work: that of the environment variable HALYARD_WORKER, or else halyard_worker of the
/// installation or build tree that the running program, or halyard's library, belongs to.
/// Throws InputError if there is none.
std::filesystem::path worker_program();

struct WorkerWatch {
  double step_limit_s = 0;  ///< the start of the program, or a step, that takes longer is the end
  /// Called now and then with the steps that the worker has done.
  std::function<void(long)> step_done = [](long) {};
  /// Says for messages where the worker is; `promise` is the one under test.
  std::function<std::string(long steps, const std::string& promise)> place;
};

/// Has a worker do the task and returns the bytes of its result. The worker is killed if this process, or the thread
/// that called, ends before it.
/// Throws InputError and std::runtime_error with the messages of those that the worker caught, WorkerEnded
/// `PLACE: what` if it gave no answer, std::system_error if it cannot be started.
std::string result_of_worker(const WorkerTask& task, const WorkerWatch& watch);

}  // namespace halyard

// halyard_worker: makes and runs an estimator for a process that does not trust it (worker_process.h). It is started by
// halyard's library, with the numbers of two open files: the shared memory with the task, and the pipe for the answer.

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <new>
#include <optional>

#include "evaluation/worker/bytes.h"
#include "evaluation/worker/supervisor.h"
#include "evaluation/worker/worker_task.h"
#include "model/input_error.h"
#include "plugins/host/conformance.h"
#include "plugins/host/loader.h"

namespace halyard {
namespace {

std::string run(const WorkerTask& task, WorkerPage& page) {
  EstimateOptions options;
  options.use_joint_torque = task.use_joint_torque;
  options.row_done = [&page](std::size_t row) { page.steps = static_cast<long>(row) + 1; };
  return estimator_run_bytes(
      run_estimator(*make_estimator(task.estimator, task.model), task.estimator, task.log, options));
}

std::string examine(const WorkerTask& task, WorkerPage& page) {
  const auto trying = [&page](const std::string& promise) {
    std::snprintf(page.promise, sizeof page.promise, "%s", promise.c_str());
    ++page.steps;
  };
  trying("making");
  std::vector<std::string> faults = conformance_faults(task.estimator, task.model, trying);
  if (task.kalman) {
    trying("Kalman");
    std::ranges::copy(kalman_faults(task.estimator), std::back_inserter(faults));
  }
  ByteWriter w;
  w.texts(faults);
  return w.take();
}

std::string describe(const WorkerTask& task) {
  const PluginInfo plugin = describe_module(task.estimator);
  ByteWriter w;
  w.texts({plugin.name, plugin.description});
  return w.take();
}

std::string result_of(const WorkerTask& task, WorkerPage& page) {
  switch (task.job) {
    case WorkerJob::describe: return describe(task);
    case WorkerJob::make: return make_estimator(task.estimator, task.model), std::string();
    case WorkerJob::run: return run(task, page);
    case WorkerJob::examine: return examine(task, page);
    case WorkerJob::load: return std::string();  // done as the task was received
  }
  throw std::runtime_error("halyard_worker: unknown task");
}

std::string answer_to(WorkerPage& page, int answer) {
  const auto said = [](Answer kind, const std::string& text) { return static_cast<char>(kind) + text; };
  try {
    if (const int error = continue_in_supervised_child(answer)) return said(Answer::no_process, std::to_string(error));
    // What follows runs in the child.
    const std::string_view bytes(reinterpret_cast<const char*>(&page + 1), page.task_size);
    return said(Answer::result, result_of(receive_worker_task(bytes), page));
  } catch (const EstimatorRefusal& error) {
    return said(Answer::refusal, error.what());
  } catch (const InputError& error) {
    return said(Answer::input_error, error.what());
  } catch (const std::bad_alloc&) {
    return said(Answer::no_memory, "");
  } catch (const std::exception& error) {
    return said(Answer::failure, error.what());
  }
}

void write_all(int file, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = write(file, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;  // nobody listens any more
    done += static_cast<std::size_t>(n);
  }
}

/// The open file that an argument names; estimators and what they start do not inherit it.
std::optional<int> open_file(const char* argument) {
  int file = -1;
  const auto end = argument + std::strlen(argument);
  if (std::from_chars(argument, end, file).ptr != end || fcntl(file, F_SETFD, FD_CLOEXEC) != 0) return {};
  return file;
}

WorkerPage* shared_page(int file) {
  struct stat status;
  if (fstat(file, &status) != 0 || status.st_size < static_cast<off_t>(sizeof(WorkerPage))) return nullptr;
  void* start = mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  return start == MAP_FAILED ? nullptr : static_cast<WorkerPage*>(start);
}

}  // namespace
}  // namespace halyard

int main(int argc, char** argv) {
  using namespace halyard;
  const std::optional<int> memory = argc == 3 ? open_file(argv[1]) : std::nullopt;
  const std::optional<int> answer = argc == 3 ? open_file(argv[2]) : std::nullopt;
  WorkerPage* page = memory && answer ? shared_page(*memory) : nullptr;
  if (!page) {
    std::fprintf(stderr, "halyard_worker: is started by halyard's library only; run halyard instead\n");
    return 2;
  }
  page->has_started = true;
  write_all(*answer, answer_to(*page, *answer));
  _exit(0);  // without the destructors of an estimator that is not trusted
}

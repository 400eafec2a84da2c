#include "evaluation/worker/worker_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <thread>

#include "plugins/host/program_location.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

/// A file that no program started by this process inherits, but for the one that it is handed to.
class OwnedFile {
 public:
  OwnedFile(int file, const char* what) : file_(file) {
    if (file < 0) fail(errno, what);
  }
  OwnedFile(const OwnedFile&) = delete;
  OwnedFile& operator=(const OwnedFile&) = delete;
  ~OwnedFile() { close(); }

  int get() const { return file_; }
  void close() {
    if (file_ >= 0) ::close(file_);
    file_ = -1;
  }

 private:
  int file_;
};

/// The memory that is shared with the worker: the page, then the task.
class SharedPage {
 public:
  explicit SharedPage(const std::string& task)
      : file_(memfd_create("halyard_task", MFD_CLOEXEC), "memfd_create"), size_(sizeof(WorkerPage) + task.size()) {
    if (ftruncate(file_.get(), static_cast<off_t>(size_)) != 0)
      fail(errno, "the memory shared with the process of an estimator");
    start_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, file_.get(), 0);
    if (start_ == MAP_FAILED) fail(errno, "mmap");
    auto* page = new (start_) WorkerPage;
    page->task_size = task.size();
    std::memcpy(static_cast<char*>(start_) + sizeof(WorkerPage), task.data(), task.size());
  }
  SharedPage(const SharedPage&) = delete;
  SharedPage& operator=(const SharedPage&) = delete;
  ~SharedPage() { munmap(start_, size_); }

  int file() const { return file_.get(); }
  const WorkerPage& operator*() const { return *static_cast<const WorkerPage*>(start_); }
  const WorkerPage* operator->() const { return &**this; }

 private:
  OwnedFile file_;
  std::size_t size_;
  void* start_;
};

/// Attributes of a worker's start: it leads a process group, and its signals are not blocked or ignored, whatever the
/// calling program does with its own.
class WorkerAttributes {
 public:
  WorkerAttributes() {
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    for (const int signal : {SIGPIPE, SIGXFSZ, SIGCHLD}) sigaddset(&signals, signal);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    posix_spawnattr_setpgroup(&attributes_, 0);
  }
  WorkerAttributes(const WorkerAttributes&) = delete;
  WorkerAttributes& operator=(const WorkerAttributes&) = delete;
  ~WorkerAttributes() { posix_spawnattr_destroy(&attributes_); }
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

/// A started worker; at the end of the scope it and all that its estimator started are killed.
class Worker {
 public:
  Worker(const fs::path& program, const SharedPage& page, int answer) : page_(page) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    // Onto themselves: they stay open in the worker, and in no other program that is started meanwhile.
    for (const int file : {page.file(), answer}) posix_spawn_file_actions_adddup2(&actions, file, file);
    std::string arguments[] = {program.string(), std::to_string(page.file()), std::to_string(answer)};
    char* argv[] = {arguments[0].data(), arguments[1].data(), arguments[2].data(), nullptr};
    const int error = posix_spawn(&id_, program.c_str(), &actions, WorkerAttributes().get(), argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) fail(error, program.string() + " cannot be started");
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() {
    if (id_ >= 0) end();
  }

  bool has_ended() const {
    siginfo_t info{};
    const int error = waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT);
    return error != 0 ? errno == ECHILD : info.si_pid == id_;  // the calling program may have taken its end
  }
  /// Has its supervisor kill what still runs, and returns how the worker ended, as waitpid() says it.
  int end() {
    ::kill(-id_, page_->has_started ? SIGTERM : SIGKILL);  // what has not started may be any program
    ::kill(-id_, SIGCONT);                                 // an estimator may have stopped its supervisor
    for (auto waited = std::chrono::milliseconds(0); !has_ended(); ++waited) {
      if (waited == kLongestEnd) ::kill(-id_, SIGKILL);  // with it ends its child
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {}
    id_ = -1;
    return status;
  }

 private:
  static constexpr std::chrono::milliseconds kLongestEnd{5000};

  const SharedPage& page_;
  pid_t id_ = -1;
};

/// Reads the answer until the worker has ended: a process that the estimator started may hold the pipe open for longer.
/// Returns false if a step took longer than the limit.
bool read_answer(int file, const Worker& worker, const WorkerPage& page, const WorkerWatch& watch,
                 std::string& answer) {
  using Clock = std::chrono::steady_clock;
  constexpr int kLookEvery = 50, kWaitForEnd = 1;  // ms
  long steps = 0;
  auto since = Clock::now();
  bool open = true;
  for (char buffer[65536];;) {
    pollfd wait{open ? file : -1, POLLIN, 0};
    const bool ended = worker.has_ended();
    if (poll(&wait, 1, ended ? 0 : open ? kLookEvery : kWaitForEnd) > 0) {
      const ssize_t n = read(file, buffer, sizeof buffer);
      if (n < 0 && errno == EINTR) continue;
      open = n > 0;
      if (open) answer.append(buffer, static_cast<std::size_t>(n));
      since = Clock::now();
    } else if (ended) {
      return true;
    }
    if (const long now = page.steps; now != steps) {
      steps = now, since = Clock::now();
      watch.step_done(steps);
    } else if (std::chrono::duration<double>(Clock::now() - since).count() > watch.step_limit_s) {
      return false;
    }
  }
}

constexpr const char* kMemoryRemedy = "free memory, use fewer --jobs, or leave this estimator out";

/// The result within an answer; throws what the worker caught.
std::string result_in(const std::string& answer, const std::string& place) {
  const std::string rest = answer.substr(1);
  switch (static_cast<Answer>(answer[0])) {
    case Answer::result: return rest;
    case Answer::refusal: throw EstimatorRefusal(rest);
    case Answer::input_error: throw InputError(rest);
    case Answer::failure: throw std::runtime_error(rest);
    case Answer::no_memory: throw WorkerKilled(place + "memory ran out; " + kMemoryRemedy);
    case Answer::no_process: fail(std::atoi(rest.c_str()), "the process of an estimator cannot be started");
  }
  throw std::runtime_error("its process gave an answer that cannot be read");
}

}  // namespace

fs::path worker_program() {
  std::error_code error;
  if (const char* given = std::getenv("HALYARD_WORKER")) {
    const bool is_file = fs::is_regular_file(given, error);
    if (is_file && ::access(given, X_OK) == 0) return given;
    throw NoWorker("HALYARD_WORKER: " + in_quotes(given) + (is_file ? " cannot be run" : " is no file") +
                   "; give the path of halyard_worker");
  }
  const fs::path library_folder = folder_of_code(&worker_program);
  for (const fs::path& path :
       {program_folder() / HALYARD_WORKER_FROM_PROGRAM, program_folder() / HALYARD_WORKER_IN_BUILD,
        library_folder / HALYARD_WORKER_FROM_LIBRARY, library_folder / ".." / HALYARD_WORKER_IN_BUILD})
    if (fs::is_regular_file(path, error)) return path;
  throw NoWorker(
      "halyard_worker, the program that runs estimators, is not found beside this program or halyard's libraries; "
      "install it, or give its path in the environment variable HALYARD_WORKER");
}

std::string result_of_worker(const WorkerTask& task, const WorkerWatch& watch) {
  const fs::path program = worker_program();
  const SharedPage page(worker_task_bytes(task));
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail(errno, "pipe2");
  const OwnedFile answer_end(ends[0], "pipe2");
  OwnedFile worker_end(ends[1], "pipe2");
  Worker worker(program, page, worker_end.get());
  worker_end.close();

  std::string answer;
  const bool in_time = read_answer(answer_end.get(), worker, *page, watch, answer);
  const int status = worker.end();
  const std::string promise(page->promise, strnlen(page->promise, sizeof page->promise));
  const std::string place = watch.place(page->steps, promise) + ": ";
  const auto ended = [&](const std::string& how) { return WorkerEnded(place + how); };
  if (!in_time) throw ended(fmt::format("took more than {:g} s, and was ended", watch.step_limit_s));
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
    throw WorkerKilled(place + "its process was killed, probably because memory ran out; " + kMemoryRemedy);
  if (WIFSIGNALED(status)) throw ended(fmt::format("crashed: {}", strsignal(WTERMSIG(status))));
  if (!page->has_started)
    throw NoWorker(
        fmt::format("{}: cannot be started (exit code {}); install it again", program.string(), WEXITSTATUS(status)));
  if (answer.empty()) throw ended("ended its process");
  return result_in(answer, place);
}

}  // namespace halyard

#include "evaluation/run/contained_run.h"

#include <fmt/core.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <limits>
#include <new>
#include <stdexcept>
#include <system_error>

#include "model/input_error.h"
#include "plugins/host/conformance.h"
#include "plugins/host/loader.h"

namespace halyard {
namespace {

/// What both processes see: how far the child has come.
struct Shared {
  std::atomic<long> rows{0};  ///< or promises
  char promise[64] = "";      ///< under test
};

/// The child crashed, ended, or took too long.
class ChildEnded : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

class SharedMemory {
 public:
  SharedMemory() : page_(mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (page_ == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "mmap");
    new (page_) Shared;
  }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  ~SharedMemory() { munmap(page_, sizeof(Shared)); }
  Shared& operator*() const { return *static_cast<Shared*>(page_); }

 private:
  void* page_;
};

class Writer {
 public:
  void number(double x) { bytes_.append(reinterpret_cast<const char*>(&x), sizeof x); }
  void numbers(const std::vector<double>& all) {
    number(static_cast<double>(all.size()));
    bytes_.append(reinterpret_cast<const char*>(all.data()), all.size() * sizeof(double));
  }
  void text(const std::string& all) {
    number(static_cast<double>(all.size()));
    bytes_.append(all);
  }
  void signals(const Signals& all) {
    for (const auto& column : all) numbers(column);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(const std::string& bytes) : at_(bytes.data()), left_(bytes.size()) {}
  double number() {
    double x;
    copy(&x, sizeof x);
    return x;
  }
  std::vector<double> numbers() {
    std::vector<double> all(static_cast<std::size_t>(number()));
    copy(all.data(), all.size() * sizeof(double));
    return all;
  }
  std::string text() {
    std::string all(static_cast<std::size_t>(number()), '\0');
    copy(all.data(), all.size());
    return all;
  }
  Signals signals(int n) {
    Signals all;
    for (int k = 0; k < n; ++k) all.push_back(numbers());
    return all;
  }

 private:
  void copy(void* to, std::size_t size) {
    if (size > left_) throw std::runtime_error("its process ended early");
    std::memcpy(to, at_, size);
    at_ += size, left_ -= size;
  }
  const char* at_;
  std::size_t left_;
};

std::string to_bytes(const EstimatorRun& run) {
  Writer w;
  w.signals(run.estimates.joint_position);
  w.signals(run.estimates.joint_velocity);
  w.signals(run.joint_position_std);
  w.signals(run.innovation);
  w.numbers(run.nis);
  for (const double x : {double(run.report.steps), double(run.report.repaired_factors), double(run.report.gated),
                         run.microseconds_per_step})
    w.number(x);
  w.number(static_cast<double>(run.extra_outputs.size()));
  for (std::size_t i = 0; i < run.extra_outputs.size(); ++i) {
    w.text(run.extra_output_names[i]);
    w.signals(run.extra_outputs[i]);
  }
  return w.take();
}

EstimatorRun from_bytes(const std::string& bytes, const std::string& name, const Log& log) {
  Reader r(bytes);
  const int n = log.n_joints;
  EstimatorRun run = no_run(name, log);
  run.estimates.joint_position = r.signals(n);
  run.estimates.joint_velocity = r.signals(n);
  run.joint_position_std = r.signals(n);
  run.innovation = r.signals(n);
  run.nis = r.numbers();
  run.report.steps = static_cast<long>(r.number());
  run.report.repaired_factors = static_cast<long>(r.number());
  run.report.gated = static_cast<long>(r.number());
  run.microseconds_per_step = r.number();
  for (double left = r.number(); left > 0; --left) {
    run.extra_output_names.push_back(r.text());
    run.extra_outputs.push_back(r.signals(n));
  }
  return run;
}

/// What the child says with its first byte.
constexpr char kResult = 'R', kInputError = 'I', kFailure = 'F';

void write_all(int file, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = write(file, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;  // nobody listens any more
    done += static_cast<std::size_t>(n);
  }
}

template <class Work>
[[noreturn]] void be_child(int file, const Work& work) {
  std::string said;
  try {
    said = kResult + work();
  } catch (const InputError& error) {
    said = kInputError + std::string(error.what());
  } catch (const std::exception& error) {
    said = kFailure + std::string(error.what());
  }
  write_all(file, said);
  _exit(0);  // what the parent has open is not the child's to close
}

/// Runs work(shared), which gives bytes, in a child. watch(rows) is called now and then. place(shared): for messages.
template <class Work, class Watch, class Place>
std::string in_child(double step_limit_s, const Work& work, const Watch& watch, const Place& place) {
  const SharedMemory shared;
  int ends[2];
  if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) {
    close(ends[0]);
    be_child(ends[1], [&] { return work(*shared); });
  }
  close(ends[1]);

  using Clock = std::chrono::steady_clock;
  std::string said;
  long rows = 0;
  bool too_slow = false;
  auto since = Clock::now();
  for (char buffer[65536];;) {
    constexpr int kLook = 50;  // ms
    pollfd wait{ends[0], POLLIN, 0};
    if (poll(&wait, 1, kLook) > 0) {
      const ssize_t n = read(ends[0], buffer, sizeof buffer);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;
      said.append(buffer, static_cast<std::size_t>(n));
      since = Clock::now();
    }
    if (const long now = (*shared).rows; now != rows) {
      rows = now, since = Clock::now();
      watch(rows);
    } else if (std::chrono::duration<double>(Clock::now() - since).count() > step_limit_s) {
      too_slow = true;
      kill(child, SIGKILL);
      break;
    }
  }
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  if (too_slow) throw ChildEnded(fmt::format("{}: took more than {:g} s, and was ended", place(*shared), step_limit_s));
  if (WIFSIGNALED(status))
    throw ChildEnded(fmt::format("{}: crashed: {}", place(*shared), strsignal(WTERMSIG(status))));
  if (said.empty()) throw ChildEnded(fmt::format("{}: ended its process", place(*shared)));
  const std::string rest = said.substr(1);
  if (said[0] == kInputError) throw InputError(rest);
  if (said[0] == kFailure) throw std::runtime_error(rest);
  return rest;
}

}  // namespace

EstimatorRun run_contained(const std::string& name, const ArmModel& model, const Log& log,
                           const EstimateOptions& options, const ContainmentOptions& containment) {
  const std::string bytes = in_child(
      containment.step_limit_s,
      [&](Shared& shared) {
        EstimateOptions within = options;
        within.progress = {};
        within.row_done = [&shared](std::size_t row) { shared.rows = static_cast<long>(row) + 1; };
        return to_bytes(run_estimator(*make_estimator(name, model), name, log, within));
      },
      [&](long rows) {
        if (options.progress) options.progress(double(rows) / double(log.size()));
      },
      [&](const Shared& shared) {
        const std::size_t row = std::min(static_cast<std::size_t>(shared.rows), log.size() - 1);
        return fmt::format("estimator {} on {} at {:.12g} s", name, log.source, log.time[row]);
      });
  return from_bytes(bytes, name, log);
}

void check_estimator(const std::string& name, const ArmModel& model, const ContainmentOptions& containment) {
  in_child(
      containment.step_limit_s, [&](Shared&) { return make_estimator(name, model), std::string(); }, [](long) {},
      [&](const Shared&) { return fmt::format("estimator {}, being made", name); });
}

std::vector<std::string> contained_faults(const std::string& name, const ArmModel& model, bool kalman,
                                          const ContainmentOptions& containment) {
  const auto examine = [&](Shared& shared) {
    const auto trying = [&shared](const std::string& promise) {
      std::snprintf(shared.promise, sizeof shared.promise, "%s", promise.c_str());
      ++shared.rows;
    };
    trying("making");
    std::vector<std::string> faults = conformance_faults(name, model, trying);
    if (kalman) {
      trying("Kalman");
      std::ranges::copy(kalman_faults(name), std::back_inserter(faults));
    }
    Writer w;
    w.number(static_cast<double>(faults.size()));
    for (const std::string& fault : faults) w.text(fault);
    return w.take();
  };
  std::vector<std::string> faults;
  try {
    const std::string bytes = in_child(
        containment.step_limit_s, examine, [](long) {}, [](const Shared& shared) { return shared.promise; });
    Reader r(bytes);
    for (double left = r.number(); left > 0; --left) faults.push_back(r.text());
  } catch (const ChildEnded& end) {
    faults.push_back(end.what() + std::string(", the rest was not tried"));
  }
  return faults;
}

}  // namespace halyard

/// 12. A live loop: the filter in a control loop at 1 kHz, against the simulated arm as hardware.
///
///   each tick   wake up, read the motors, command a torque, update the filter, take its estimate
///   then        the arm moves on, until the next tick
///
/// Look for: the histogram of latencies, from the tick to the estimate, and that of waking up, which is the machine's
/// part. docs/live_use.md says what to do in a loop of your own. For a run of a minute at real-time priority, beside a
/// thread that loads another core:
///
///   12_live_loop --seconds 60 --fifo --load 1

#include <pthread.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <thread>

#include "estimators/built_in.h"
#include "live_arm.h"

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

double microseconds(Clock::duration d) { return std::chrono::duration<double, std::micro>(d).count(); }

class Histogram {
 public:
  void add(Clock::duration d) {
    const double us = microseconds(d);
    std::size_t bin = 0;
    while (bin < std::size(kEdges) && us >= kEdges[bin]) ++bin;
    ++count_[bin];
    largest_ = std::max(largest_, us);
  }
  void print(const char* title) const {
    fmt::print("{}: at most {:.1f} us\n", title, largest_);
    for (std::size_t bin = 0; bin < std::size(count_); ++bin)
      if (count_[bin] > 0)
        fmt::print("  {:>4} to {:>4} us  {:>7}\n", bin == 0 ? 0 : kEdges[bin - 1],
                   bin < std::size(kEdges) ? fmt::format("{}", kEdges[bin]) : "...", count_[bin]);
  }

 private:
  static constexpr int kEdges[] = {5, 10, 20, 30, 50, 75, 100, 200, 500, 1000};
  long count_[std::size(kEdges) + 1] = {};
  double largest_ = 0;
};

/// Real-time priority and memory that stays in place, as far as this user is allowed to.
void become_real_time(bool fifo) {
  prctl(PR_SET_TIMERSLACK, 1);
  const bool locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  sched_param priority{};
  priority.sched_priority = 80;
  const bool granted = fifo && pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority) == 0;
  fmt::print("SCHED_FIFO: {}; memory locked: {}\n",
             granted ? "yes"
             : fifo  ? "not allowed"
                     : "not asked for",
             locked ? "yes" : "not allowed");
}

/// Threads that compute without end, until the object is destroyed.
class Load {
 public:
  explicit Load(int threads) {
    for (int i = 0; i < threads; ++i)
      threads_.emplace_back([](const std::stop_token& stop) {
        std::atomic<double> x = 1;
        while (!stop.stop_requested()) x = std::sqrt(x + 1);
      });
  }

 private:
  std::vector<std::jthread> threads_;
};

}  // namespace

int main(int argc, char** argv) {
  using namespace halyard;
  CLI::App app("The filter in a control loop at 1 kHz");
  double seconds = 2;
  std::string name = "sr_ukf";
  bool fifo = false;
  int load = 0;
  app.add_option("--seconds", seconds, "length of the run")->check(CLI::Range(1.0, 1e5));
  app.add_option("--estimator", name)->check(CLI::IsMember({"ekf", "sr_ukf"}));
  app.add_flag("--fifo", fifo, "ask for real-time priority (SCHED_FIFO)");
  app.add_option("--load", load, "number of threads that keep other cores busy")->check(CLI::Range(0, 64));
  CLI11_PARSE(app, argc, argv);

  const ArmModel model = raven2();
  const auto period = 1ms;
  const double period_s = std::chrono::duration<double>(period).count();
  LiveArm arm(model, period_s);
  const auto filter = name == "ekf" ? make_ekf(model, {}) : make_sr_ukf(model, {});
  const auto kinematics = make_kinematics(model, {});
  const Load busy(load);
  become_real_time(fifo);

  const Sample first = arm.tick(0);
  filter->reset(first);
  kinematics->reset(first);
  Histogram waking, update, latency;
  Eigen::VectorXd error = Eigen::VectorXd::Zero(model.n()), naive = error;
  long late = 0, missed = 0, samples = 0;
  const Clock::time_point start = Clock::now();
  for (long tick = 1; static_cast<double>(tick) * period_s <= seconds; ++tick) {
    arm.advance(static_cast<double>(tick) * period_s);
    if (Clock::now() >= start + (tick + 1) * period) {  // its time is over: the filter gets no sample of this tick
      ++missed;
      continue;
    }
    std::this_thread::sleep_until(start + tick * period);
    waking.add(Clock::now() - (start + tick * period));
    const Sample sample = arm.tick(static_cast<double>(tick) * period_s);
    const Clock::time_point begin = Clock::now();
    filter->update(sample);
    const Estimate estimate = filter->estimate();
    const Clock::time_point end = Clock::now();
    update.add(end - begin);
    latency.add(end - (start + tick * period));
    if (end >= start + (tick + 1) * period) ++late;

    kinematics->update(sample);
    ++samples;
    error += (estimate.joint_position - arm.joint_position()).cwiseAbs2();
    naive += (kinematics->estimate().joint_position - arm.joint_position()).cwiseAbs2();
  }

  fmt::print("{}, {:.0f} s at 1 kHz: {} samples, {} late, {} missed\n", name, seconds, samples, late, missed);
  waking.print("from the tick to waking up");
  update.print("update and estimate");
  latency.print("from the tick to the estimate");
  std::string closer;
  for (int k = 0; k < model.n(); ++k)
    if (error(k) < naive(k)) closer += fmt::format(" {}", k + 1);
  fmt::print("the filter is closer than kinematics at joints:{}\n", closer);
}

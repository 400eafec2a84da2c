/// halyard_endurance: filters over torn records (tests/support/torn_record.h) of long runs, on chains of 1 to 7 joints
/// with soft and stiff cables, with the paper's weights and with wide ones. See bench/README.md.
///
/// Exit code 1 too if a filter threw, or gave a number that is not finite or a deviation of none.

#include <fmt/core.h>
#include <tbb/parallel_for_each.h>

#include <cstdio>
#include <deque>
#include <mutex>

#include "bench/program.h"
#include "estimators/built_in.h"
#include "estimators/filters/kinematics.h"
#include "tests/support/arm_runs.h"
#include "tests/support/torn_record.h"

namespace halyard {
namespace {

struct Filter {
  const char* name;
  std::unique_ptr<Estimator> (*make)(const ArmModel&, const EstimatorOptions&);
  EstimatorOptions options;
};

const std::vector<Filter>& filters() {
  static const std::vector<Filter> all = {{"sr_ukf, paper's weights", make_sr_ukf, {{"gate", "0.999999"}}},
                                          {"sr_ukf, alpha 1", make_sr_ukf, {{"gate", "0.999999"}, {"alpha", "1"}}},
                                          {"ekf", make_ekf, {{"gate", "0.999999"}}},
                                          {"disturbance_sr_ukf", make_disturbance_sr_ukf, {{"gate", "0.999999"}}},
                                          {"camera_sr_ukf", make_camera_sr_ukf, {{"gate", "0.999999"}}},
                                          {"smoother", make_smoother, {{"gate", "0.999999"}}}};
  return all;
}

struct Case {
  int joints;
  double stiffer;
  const Filter* filter;
};

struct Outcome {
  std::string failure;
  EstimatorReport report;
  double worst = 0, rms = 0, naive = 0;  ///< largest std; RMS of joint 1, of the filter and of the kinematics
};

/// Where a camera saw the marker, exposed 50 samples ago, every 33rd sample.
class LateMarker {
 public:
  Eigen::VectorXd at(long sample, const ArmModel& model, const Eigen::VectorXd& q) {
    Eigen::VectorXd marker(3);
    position_of(model.nominal, chain_pose(model.nominal, q.data()), model.nominal.payload_point, marker.data());
    positions_.push_back(marker);
    if (positions_.size() <= 50) return {};
    marker = positions_.front();
    positions_.pop_front();
    return sample % 33 == 0 ? marker : Eigen::VectorXd();
  }

 private:
  std::deque<Eigen::VectorXd> positions_;
};

bool is_sane(const Estimate& e) {
  return e.joint_position.allFinite() && e.joint_velocity.allFinite() && e.joint_position_std.minCoeff() > 0 &&
         e.joint_position_std.allFinite();
}

Outcome endure(const Case& c, long steps, std::uint64_t seed) {
  const ArmModel model = chain_of(c.joints, c.stiffer);
  Outcome outcome;
  DrivenArm arm(model);
  TornRecord record(model, seed);
  LateMarker marker;
  const auto filter = c.filter->make(model, c.filter->options), naive = make_kinematics(model, {});
  double square = 0, naive_square = 0;
  long counted = 0;
  try {
    for (long i = 0; i <= steps; ++i) {
      const Eigen::VectorXd truth = arm.joint_position();
      Sample whole = arm.next();
      whole.marker = marker.at(i, model, truth);
      const std::optional<Sample> s = record.torn(whole);
      if (i == 0) naive->reset(whole), filter->reset(*s);
      if (i == 0 || !s) continue;
      filter->update(*s);
      naive->update(whole);
      const Estimate e = filter->estimate();
      if (!is_sane(e)) throw std::runtime_error(fmt::format("no sane estimate at {:.3f} s", s->time_s));
      while (const std::optional<Revision> revision = filter->revise(i == steps))
        if (!is_sane(revision->estimate))
          throw std::runtime_error(fmt::format("no sane revision of {:.3f} s", revision->time_s));
      outcome.worst = std::max(outcome.worst, e.joint_position_std.maxCoeff());
      if (s->time_s < 2) continue;  // the wrong start
      square += std::pow(e.joint_position(0) - truth(0), 2);
      naive_square += std::pow(naive->estimate().joint_position(0) - truth(0), 2);
      ++counted;
    }
  } catch (const std::exception& error) {
    outcome.failure = error.what();
  }
  outcome.report = filter->report();
  outcome.rms = std::sqrt(square / static_cast<double>(counted));
  outcome.naive = std::sqrt(naive_square / static_cast<double>(counted));
  return outcome;
}

struct Options {
  long steps = 20000;
  int joints = 0;
  double stiffer = 0;
  std::uint64_t seed = 1;
};

/// Whether every filter stayed sane.
bool run(const Options& options) {
  std::vector<Case> cases;
  for (int n = 1; n <= kMaxJoints; ++n)
    for (const double s : {0.1, 1.0, 10.0})
      for (const Filter& filter : filters())
        if ((options.joints == 0 || n == options.joints) && (options.stiffer == 0 || s == options.stiffer))
          cases.push_back({n, s, &filter});
  if (cases.empty())
    for (const Filter& filter : filters())
      cases.push_back({options.joints == 0 ? 3 : options.joints, options.stiffer, &filter});

  fmt::print("{:>6} {:>8}  {:<24} {:>9} {:>6} {:>8} {:>11} {:>11} {:>11}\n", "joints", "cables", "filter", "steps",
             "gated", "repaired", "largest std", "RMS, rad", "kinematics");
  std::mutex one_at_a_time;
  bool sane = true;
  tbb::parallel_for_each(cases, [&](const Case& c) {
    const Outcome o = endure(c, options.steps, options.seed);
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    fmt::print("{:>6} {:>7}x  {:<24} {:>9} {:>6} {:>8} {:>11.3g} {:>11.3g} {:>11.3g}  {}\n", c.joints, c.stiffer,
               c.filter->name, o.report.steps, o.report.gated, o.report.repaired_factors, o.worst, o.rms, o.naive,
               o.failure);
    std::fflush(stdout);
    sane = sane && o.failure.empty();
  });
  return sane;
}

int run_command_line(int argc, char** argv) {
  CLI::App app("Filters over long torn records.");
  Options options;
  app.add_option("--steps", options.steps, "samples of each case")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--joints", options.joints, "of this chain alone; default: 1 to 7")->check(CLI::Range(1, kMaxJoints));
  app.add_option("--stiffer", options.stiffer, "cables so many times as stiff; default: 0.1, 1 and 10")
      ->check(CLI::PositiveNumber);
  app.add_option("--seed", options.seed, "of the tearing")->capture_default_str();
  return run_program(app, argc, argv, [&] { return run(options) ? 0 : 1; });
}

}  // namespace
}  // namespace halyard

int main(int argc, char** argv) { return halyard::run_command_line(argc, argv); }

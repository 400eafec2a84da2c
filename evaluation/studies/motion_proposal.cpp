#include "evaluation/studies/motion_proposal.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <boost/random/uniform_int_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <system_error>

#include "model/machine/first_failure.h"
#include "model/output/number_text.h"
#include "plant/simulate.h"
#include "plant/trajectory.h"

namespace halyard {
namespace {

constexpr int kMotions = 24;
/// A motion that shows an effect from a size on that is so many times the given motion's is no gain.
constexpr double kWorseLimit = 2;

struct Range {
  double lower, upper;
};

/// What the joint may do: its range, or where it has none what the given motion asks for.
Range range_of(const Scenario& given, int k) {
  const JointDescription& joint = given.robot.joints[k];
  if (joint.lower < joint.upper) return {joint.lower, joint.upper};
  Range range{joint.home, joint.home};
  for (double t = 0; t <= given.duration_s; t += 0.01) {
    const double q = desired_position(given.trajectory[k], given.fade_in_s, t);
    range = {std::min(range.lower, q), std::max(range.upper, q)};
  }
  return range;
}

/// Readable in a file, and there the same number.
double rounded(double value) { return rounded_to_digits(value, 4); }

class Draw {
 public:
  explicit Draw(int i) : random_(static_cast<std::uint64_t>(i)) {}
  double uniform(double a, double b) { return boost::random::uniform_real_distribution<double>(a, b)(random_); }
  double logarithmic(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }
  int whole(int a, int b) { return boost::random::uniform_int_distribution<int>(a, b)(random_); }

  JointTrajectory trajectory(const Range& range) {
    const double half = 0.95 * (range.upper - range.lower) / 2, reach = uniform(0.15, 1) * half;
    const double center = (range.lower + range.upper) / 2 + uniform(-1, 1) * (half - reach);
    JointTrajectory t;
    if (whole(0, 1) == 0) {
      t.kind = JointTrajectory::Kind::point_to_point;
      for (int points = whole(3, 6); points > 0; --points) t.points.push_back(rounded(center + uniform(-1, 1) * reach));
      t.move_s = rounded(logarithmic(0.3, 3));
      t.dwell_s = rounded(uniform(0, 1));
      return t;
    }
    t.kind = JointTrajectory::Kind::sines;
    t.center = rounded(center);
    double frequency = logarithmic(0.1, 0.8), whole_weight = 0;
    for (int sines = whole(2, 3); sines > 0; --sines) {
      // Faster sines are smaller, so that they ask for no more speed.
      t.sines.push_back({uniform(0.5, 1) / frequency, rounded(frequency), rounded(uniform(0, 2 * std::numbers::pi))});
      whole_weight += t.sines.back().amplitude;
      frequency *= uniform(1.3, 4);
    }
    for (Sine& sine : t.sines) sine.amplitude = rounded(sine.amplitude / whole_weight * reach);
    return t;
  }

 private:
  std::mt19937_64 random_;
};

double size(const DetectionLimit& limit) { return std::abs(limit.limit - limit.neutral); }

bool shows_as_well(const DetectionLimit& now, const DetectionLimit& given) {
  return now.excited && (!given.excited || size(now) <= kWorseLimit * size(given));
}

}  // namespace

Scenario planned_scenario(Scenario scenario, const ArmModel& model) {
  scenario.robot = model;
  scenario.assumed = model;
  scenario.quantise = true;
  return scenario;
}

Log planned_log(const Scenario& scenario, bool joint_sensor, const std::function<void(double)>& progress) {
  Log log = simulate(faster(scenario), progress).measured;
  log.source = scenario.name;
  if (!joint_sensor)
    for (auto& column : log.joint_position) column.clear();
  return log;
}

Scenario random_motion(const Scenario& given, int i) {
  Scenario s = given;
  s.name = fmt::format("motion {} of the search", i);
  s.integrator = {};
  Draw draw(i);
  for (int k = 0; k < s.robot.n(); ++k) {
    const JointTrajectory drawn = draw.trajectory(range_of(given, k));
    if (given.robot.joints[k].controller.acts()) s.trajectory[k] = drawn;
  }
  return s;
}

SeparatingMotion separating_motion(const Scenario& given, const Log& given_log, const PlacedEffect& first,
                                   const PlacedEffect& second, bool joint_sensor,
                                   const std::function<void(const std::string&, double)>& progress) {
  SeparatingMotion best{first, second, separation(given.robot, {given_log}, first, second), {}, {}, {}, kMotions};
  struct Tried {
    Log log;
    Separation separation;
  };
  std::vector<Tried> tried(kMotions);
  std::atomic<int> done{0};
  for_each_in_parallel(kMotions, [&](std::size_t motion) {
    const int i = static_cast<int>(motion);
    try {
      tried[i].log = planned_log(random_motion(given, i + 1), joint_sensor);
      tried[i].separation = separation(given.robot, {tried[i].log}, first, second);
    } catch (const std::system_error&) {
      throw;  // of this machine, and not of the motion
    } catch (const std::runtime_error&) {
      tried[i].separation.cosine = 1;  // a motion that the arm cannot follow, or that shows nothing, is none
    }
    if (progress) progress("motions that separate", static_cast<double>(++done) / kMotions);
  });
  double least = best.given.cosine;
  for (int i = 0; i < kMotions; ++i) {
    const Separation& s = tried[i].separation;
    if (!shows_as_well(s.first, best.given.first) || !shows_as_well(s.second, best.given.second) || s.cosine >= least)
      continue;
    least = s.cosine;
    best.scenario = random_motion(given, i + 1);
    best.proposed = s;
    best.log = std::move(tried[i].log);
  }
  return best;
}

}  // namespace halyard

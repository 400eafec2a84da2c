#include "bench/diagnosis/draw/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant/trajectory.h"

namespace halyard::blind {
namespace {

JointTrajectory random_sines(double center, double reach, double most_acceleration, Random& random) {
  JointTrajectory t;
  t.kind = JointTrajectory::Kind::sines;
  t.center = center;
  double sum = 0, acceleration = 0;
  for (int i = 2 + random.below(3); i > 0; --i) {
    const double f = random.log_uniform(0.1, 1), w = 2 * std::numbers::pi * f;
    const double amplitude = random.uniform(0.3, 1) / f;
    t.sines.push_back({amplitude, f, random.uniform(-std::numbers::pi, std::numbers::pi)});
    sum += amplitude;
    acceleration += amplitude * w * w;
  }
  const double scale = std::min(reach / sum, most_acceleration / acceleration);
  for (Sine& s : t.sines) s.amplitude *= scale;
  return t;
}

JointTrajectory random_moves(double center, double reach, double most_acceleration, Random& random) {
  JointTrajectory t;
  t.kind = JointTrajectory::Kind::point_to_point;
  double longest = 0;
  for (int i = 3 + random.below(3); i > 0; --i) {
    t.points.push_back(center + reach * random.uniform(-1, 1));
    if (t.points.size() > 1) longest = std::max(longest, std::abs(t.points.back() - t.points[t.points.size() - 2]));
  }
  longest = std::max(longest, std::abs(t.points.front() - t.points.back()));
  constexpr double kPeak = 5.774;  // of a minimum-jerk move's acceleration, in distance / time²
  t.move_s = std::max(random.uniform(0.7, 2), std::sqrt(kPeak * longest / most_acceleration));
  t.dwell_s = random.uniform(0.2, 0.8);
  return t;
}

}  // namespace

std::vector<JointTrajectory> random_motion(const ArmModel& model, Random& random) {
  std::vector<JointTrajectory> all;
  for (int k = 0; k < model.n(); ++k) {
    const JointDescription& range = model.joints[k];
    const double half = (range.upper - range.lower) / 2, middle = range.lower + half;
    const double center = middle + random.uniform(-0.5, 0.5) * half;
    const double reach = random.uniform(0.4, 0.9) * (half - std::abs(center - middle));
    const double most = model.nominal.joint[k].type == JointType::revolute ? 6.0 : 0.6;
    all.push_back(random.chance(0.7) ? random_sines(center, reach, most, random)
                                     : random_moves(center, reach, most, random));
  }
  return all;
}

Travel travel_of(const JointTrajectory& trajectory, double fade_in_s, double from_s, double to_s) {
  constexpr double kStep = 0.01;
  double last = desired_position(trajectory, fade_in_s, from_s);
  Travel travel{last, last, 0};
  for (double t = from_s + kStep; t <= to_s; t += kStep) {
    const double q = desired_position(trajectory, fade_in_s, t);
    travel.least = std::min(travel.least, q);
    travel.most = std::max(travel.most, q);
    travel.fastest = std::max(travel.fastest, std::abs(q - last) / kStep);
    last = q;
  }
  return travel;
}

}  // namespace halyard::blind

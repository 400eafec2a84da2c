#include "plant/trajectory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/input_error.h"

namespace halyard {
namespace {

double minimum_jerk(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 + s * (-15 + 6 * s));
}

double sines_at(const JointTrajectory& t, double fade_in_s, double time_s) {
  double sum = 0;
  for (const Sine& sine : t.sines)
    sum += sine.amplitude * std::sin(2 * std::numbers::pi * sine.frequency_hz * time_s + sine.phase);
  return t.center + (fade_in_s > 0 ? minimum_jerk(time_s / fade_in_s) : 1) * sum;
}

double point_at(const JointTrajectory& t, double time_s) {
  const double leg = t.move_s + t.dwell_s;
  const double legs_done = std::floor(time_s / leg);
  const auto n = t.points.size();
  const auto i = static_cast<std::size_t>(std::fmod(legs_done, static_cast<double>(n)));
  const double from = t.points[i], to = t.points[(i + 1) % n];
  return from + (to - from) * minimum_jerk((time_s - legs_done * leg) / t.move_s);
}

double sample_at(const JointTrajectory& t, double time_s) {
  const auto next = std::upper_bound(t.sample_time.begin(), t.sample_time.end(), time_s) - t.sample_time.begin();
  if (next == 0) return t.sample_position.front();
  if (next == std::ssize(t.sample_time)) return t.sample_position.back();
  const double share = (time_s - t.sample_time[next - 1]) / (t.sample_time[next] - t.sample_time[next - 1]);
  return std::lerp(t.sample_position[next - 1], t.sample_position[next], share);
}

}  // namespace

void check_trajectory(const JointTrajectory& t) {
  if (t.kind == JointTrajectory::Kind::point_to_point) {
    if (t.points.empty()) throw InputError("no points: give at least one position to stand at");
    if (!(t.move_s > 0) || !(t.dwell_s >= 0))
      throw InputError("moves must take more than 0 s and dwells not less than 0 s");
    constexpr double kShortest = 1e-6;  // s, as the shortest period of control
    if (t.move_s + t.dwell_s < kShortest) throw InputError("a move and its dwell must take at least 1e-6 s together");
  }
  if (t.kind == JointTrajectory::Kind::samples) {
    if (t.sample_time.empty() || t.sample_time.size() != t.sample_position.size())
      throw InputError("no samples, or not one position for each time");
    if (std::adjacent_find(t.sample_time.begin(), t.sample_time.end(), std::greater_equal<>()) != t.sample_time.end())
      throw InputError("times of samples do not increase");
  }
}

double desired_position(const JointTrajectory& t, double fade_in_s, double time_s) {
  switch (t.kind) {
    case JointTrajectory::Kind::hold: return t.center;
    case JointTrajectory::Kind::sines: return sines_at(t, fade_in_s, time_s);
    case JointTrajectory::Kind::point_to_point: return point_at(t, time_s);
    case JointTrajectory::Kind::samples: return sample_at(t, time_s);
  }
  return t.center;
}

}  // namespace halyard

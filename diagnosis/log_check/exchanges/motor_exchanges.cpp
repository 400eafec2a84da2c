#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "diagnosis/log_check/exchanges/assignment.h"
#include "diagnosis/log_check/exchanges/exchanges.h"
#include "diagnosis/log_check/torques/needed_torques.h"

namespace halyard {
namespace {

double beyond_range(const LogUnderCheck& c, const SampledMotion& m, int k) {
  return c.beyond_range(k, m.expected[k], c.model.nominal.joint[k].motor_zero_known);
}

/// Motors without a sensor at their joint, whose torques tell something.
std::vector<int> motors_without_sensor(const LogUnderCheck& c) {
  std::vector<int> motors;
  for (int k = 0; k < c.n(); ++k)
    if (c.is_driven(k) && !c.log.motor_position[k].empty() && c.log.joint_position[k].empty() &&
        !c.log.motor_torque[k].empty() && has_known_scale(c, k))
      motors.push_back(k);
  return motors;
}

/// The permutations of these motors that put each of them into its range.
std::vector<std::vector<int>> within_ranges(const LogUnderCheck& c, const std::vector<int>& motors) {
  constexpr std::size_t kMost = 6;  // all of three motors; each takes a comparison of torques
  const auto n = static_cast<int>(motors.size());
  const PlaceCost cost = [&](const std::vector<int>& columns) {
    const auto circles = circles_of(&Log::motor_position, motors, completed(columns, n));
    const LogUnderCheck trial = after_exchange(c, circles);
    const double beyond = beyond_range(trial, sampled_motion(trial.log, c.model), motors[columns.size() - 1]);
    return beyond > c.rule.outside ? std::numeric_limits<double>::infinity() : beyond;
  };
  return best_assignments(n, cost, kMost);
}

/// How well the torques of some motors go with their motions.
struct Fit {
  double least = 1;  ///< correlation
  double left = 0;   ///< mean share of the variances that they do not explain
};

/// Of the motors of some circles, in a log in which they are exchanged or not.
Fit fit_of(const LogUnderCheck& c, const std::vector<ColumnCircle>& circles) {
  const auto t = needed_torques(c);
  Fit fit;
  double n = 0;
  for (const ColumnCircle& circle : circles)
    for (const ColumnPlace& place : circle) {
      const Correlation r = t ? significant(c, *t, place.k, place.k) : Correlation{};
      fit.least = std::min(fit.least, r.r), fit.left += unexplained(r), n += 1;
    }
  fit.left /= n;
  return fit;
}

}  // namespace

void check_motor_exchanges(LogUnderCheck& c) {
  const std::vector<int> motors = motors_without_sensor(c);
  const SampledMotion m = sampled_motion(c.log, c.model);
  if (std::ranges::none_of(motors, [&](int k) { return beyond_range(c, m, k) > c.rule.outside; })) return;
  std::vector<ColumnCircle> best;
  Fit fit{.least = 0, .left = 1};
  for (const std::vector<int>& p : within_ranges(c, motors)) {
    const std::vector<ColumnCircle> circles = circles_of(&Log::motor_position, motors, p);
    if (const Fit after = fit_of(after_exchange(c, circles), circles); after.left < fit.left)
      best = circles, fit = after;
  }
  if (fit.least < c.rule.torque_goes_with || fit.left > c.rule.swap_leaves * fit_of(c, best).left) return;
  for (const ColumnCircle& circle : best)
    reject_exchange(c, circle,
                    fmt::format("once exchanged, the joints move within their ranges and the torques go with the "
                                "motions (correlation at least {:.2f}); as they are, a joint leaves its range",
                                fit.least));
}

}  // namespace halyard

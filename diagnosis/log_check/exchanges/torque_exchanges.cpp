#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "diagnosis/log_check/exchanges/assignment.h"
#include "diagnosis/log_check/exchanges/exchanges.h"
#include "diagnosis/log_check/torques/needed_torques.h"

namespace halyard {
namespace {

/// How well the motion of motor k goes with the torque of another one, compared with its own.
enum class Match { no, weak, clear };

Match match(const LogUnderCheck& c, const TorqueComparison& t, int other, int k) {
  const double r_own = significant(c, t, k, k).r, r_other = significant(c, t, other, k).r;
  const bool better = 1 - r_other * r_other < c.rule.swap_leaves * (1 - r_own * r_own);
  if (r_own <= c.rule.own_torque && r_other >= c.rule.torque_goes_with && better) return Match::clear;
  return r_own <= 0 && r_other >= -c.rule.torque_opposes ? Match::weak : Match::no;
}

/// The circles of torques that go best with each other's motions, each of which matches so well at least.
std::vector<ColumnCircle> best_circles(const LogUnderCheck& c, const TorqueComparison& t, Match least) {
  std::vector<int> motors;
  for (int k = 0; k < c.n(); ++k)
    if (c.is_driven(k) && has_known_scale(c, k)) motors.push_back(k);
  const auto n = static_cast<int>(motors.size());
  std::vector<std::vector<double>> cost(n, std::vector<double>(n, std::numeric_limits<double>::infinity()));
  for (int place = 0; place < n; ++place)
    for (int column = 0; column < n; ++column)
      if (column == place || match(c, t, motors[column], motors[place]) >= least)
        cost[place][column] = unexplained(significant(c, t, motors[column], motors[place]));
  const PlaceCost of_place = [&](const std::vector<int>& columns) { return cost[columns.size() - 1][columns.back()]; };
  return circles_of(&Log::motor_torque, motors, best_assignments(n, of_place, 1).front());
}

/// An effect may hide one match of a circle of three or more, where the others leave its torque no other place.
std::vector<ColumnCircle> torque_circles(const LogUnderCheck& c, const TorqueComparison& t) {
  const auto is_clear = [&](const ColumnCircle& circle) {
    std::size_t weak = 0;
    for (std::size_t i = 0; i < circle.size(); ++i)
      weak += match(c, t, circle[(i + 1) % circle.size()].k, circle[i].k) == Match::weak;
    return weak == 0 || (weak == 1 && circle.size() > 2);
  };
  const std::vector<ColumnCircle> circles = best_circles(c, t, Match::weak);
  return std::ranges::all_of(circles, is_clear) ? circles : best_circles(c, t, Match::clear);
}

/// The exchange of the motors' positions that gives each torque its own motion.
ColumnCircle of_positions(const ColumnCircle& torques) {
  ColumnCircle circle = torques;
  std::reverse(circle.begin() + 1, circle.end());
  for (ColumnPlace& place : circle) place.signal = &Log::motor_position;
  return circle;
}

/// How badly a log fits after an exchange: what the torques leave, and positions beyond their ranges.
double misfit_after(const LogUnderCheck& c, const ColumnCircle& circle) {
  const LogUnderCheck trial = after_exchange(c, {circle});
  const auto t = needed_torques(trial);
  if (!t) return std::numeric_limits<double>::infinity();
  const SampledMotion m = sampled_motion(trial.log, c.model);
  double misfit = 0;
  for (const ColumnPlace& place : circle)
    misfit += unexplained(significant(c, *t, place.k, place.k)) +
              c.beyond_range(place.k, m.expected[place.k], c.model.nominal.joint[place.k].motor_zero_known);
  return misfit;
}

/// Without sensors at the joints either the torques or the positions may be exchanged.
void reject_circle(LogUnderCheck& c, const TorqueComparison& t, const ColumnCircle& torques) {
  double straight = 0, crossed = 1;
  bool has_sensor = false;
  for (std::size_t i = 0; i < torques.size(); ++i) {
    const int k = torques[i].k, behind = torques[(i + 1) % torques.size()].k;
    straight = std::max(straight, significant(c, t, k, k).r);
    crossed = std::min(crossed, significant(c, t, behind, k).r);
    has_sensor = has_sensor || !c.log.joint_position[k].empty();
  }
  const ColumnCircle positions = of_positions(torques);
  const double of_torques = has_sensor ? 0 : misfit_after(c, torques);
  const double of_motors = has_sensor ? std::numeric_limits<double>::infinity() : misfit_after(c, positions);
  const bool are_motors = of_motors < of_torques;
  const ColumnCircle &wrong = are_motors ? positions : torques, &other = are_motors ? torques : positions;
  const bool told = std::min(of_motors, of_torques) < c.rule.swap_leaves * std::max(of_motors, of_torques);
  reject_exchange(c, wrong,
                  fmt::format("{} goes with {} motor's motion (correlation at least {:.2f}) and less with its own (at "
                              "most {:.2f})",
                              are_motors ? "the torque of each" : "each", wrong.size() == 2 ? "the other" : "another",
                              crossed, straight),
                  told ? ""
                       : fmt::format(", or the motors' {} with {}", are_motors ? "torques" : "positions",
                                     c.exchange_options(other)));
}

}  // namespace

bool check_torque_exchanges(LogUnderCheck& c, const TorqueComparison& t) {
  const std::vector<ColumnCircle> circles = torque_circles(c, t);
  for (const ColumnCircle& circle : circles) reject_circle(c, t, circle);
  return !circles.empty();
}

}  // namespace halyard

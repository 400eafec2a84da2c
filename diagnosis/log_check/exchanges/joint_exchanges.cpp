#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "diagnosis/log_check/agreement.h"
#include "diagnosis/log_check/exchanges/exchanges.h"
#include "diagnosis/log_check/torques/needed_torques.h"

namespace halyard {
namespace {

bool has_torque(const ColumnCircle& pair) {
  return pair[0].signal == &Log::motor_torque || pair[1].signal == &Log::motor_torque;
}

/// Whether both columns are there, and can have each other's values. The period of a counter would be none of a torque.
bool is_possible(const LogUnderCheck& c, const ColumnCircle& pair) {
  for (const ColumnPlace& place : pair)
    if ((c.log.*place.signal)[place.k].empty() || (has_torque(pair) && c.wrap_of(place.name()) > 0)) return false;
  return true;
}

/// A pair of columns, and how badly it explains the log; smaller is better.
struct PairAtJoint {
  ColumnCircle pair;
  double misfit;
};

/// The exchange at joint k that makes its reading agree with its motor.
std::optional<PairAtJoint> best_exchange(const LogUnderCheck& c, int k) {
  const JointParameters<double>& j = c.model.nominal.joint[k];
  const ColumnPlace motor{&Log::motor_position, k}, joint{&Log::joint_position, k}, torque{&Log::motor_torque, k};
  std::optional<PairAtJoint> best;
  for (const ColumnCircle& pair :
       {ColumnCircle{motor, joint}, ColumnCircle{motor, torque}, ColumnCircle{joint, torque}}) {
    if (!is_possible(c, pair)) continue;
    const LogUnderCheck trial = after_exchange(c, {pair});
    const SampledMotion m = sampled_motion(trial.log, c.model);
    // What the motors inboard give is no evidence of the exchange.
    if (!moves(c, k, m.own[k]) || disagreement(trial, m, k, c.rule.explained_by_swap) == kDisagrees) continue;
    const double misfit = misfit_of_slope(c, slope_at(m, k).slope, 1) +
                          c.beyond_range(k, m.joint[k], j.joint_zero_known) +
                          c.beyond_range(k, m.expected[k], j.motor_zero_known);
    if (!best || misfit < best->misfit) best = {pair, misfit};
  }
  return best;
}

/// With a sensor at the joint.
void check_by_reading(LogUnderCheck& c, const SampledMotion& m, int k) {
  if (m.expected[k].empty() || m.joint[k].empty()) return;
  if (!moves(c, k, m.joint[k]) && !moves(c, k, m.expected[k])) return;
  if (disagreement(c, m, k, c.rule.explained) < kDisagrees) return;
  const std::optional<PairAtJoint> best = best_exchange(c, k);
  if (!best) return;
  const Slope s = slope_at(m, k);
  if (s.explained >= c.rule.explained)
    if (const auto unit = unit_that_explains(c, m, k, s.slope); unit && unit->misfit <= best->misfit) return;
  reject_exchange(c, best->pair,
                  fmt::format("once exchanged, joint {}'s reading follows its motor; as they are, it does not", k + 1));
}

/// Without one: the motor's position hardly moves the joint, its torque would within the joint's range, and once they
/// are exchanged the torque goes with the motion.
void check_by_torque(LogUnderCheck& c, const SampledMotion& of_log, int k) {
  const ColumnCircle pair = {{&Log::motor_position, k}, {&Log::motor_torque, k}};
  if (!c.is_driven(k) || !c.log.joint_position[k].empty() || !is_possible(c, pair) || !has_known_scale(c, k)) return;
  const JointParameters<double>& j = c.model.nominal.joint[k];
  if (!j.motor_zero_known || moves(c, k, of_log.own[k])) return;
  const LogUnderCheck trial = after_exchange(c, {pair});
  const SampledMotion m = sampled_motion(trial.log, c.model);
  if (!moves(c, k, m.own[k]) || c.beyond_range(k, m.expected[k], j.motor_zero_known) > c.rule.outside) return;
  const auto t = needed_torques(trial);
  if (!t) return;
  const Correlation r = significant(c, *t, k, k);
  if (r.r < c.rule.torque_goes_with || std::abs(std::log(r.size)) > std::log(c.rule.torque_ratio)) return;
  reject_exchange(
      c, pair,
      fmt::format("once exchanged, the torque goes with the motor's motion (correlation {:.2f}) and the joint "
                  "moves within its range; as they are, motor {} hardly moves",
                  r.r, k + 1));
}

}  // namespace

void check_exchanges_at_joints(LogUnderCheck& c) {
  SampledMotion m = sampled_motion(c.log, c.model);
  for (int k = 0; k < c.n(); ++k) {
    const std::size_t before = c.findings.size();
    check_by_reading(c, m, k);
    check_by_torque(c, m, k);
    if (c.findings.size() > before) m = sampled_motion(c.log, c.model);
  }
}

}  // namespace halyard

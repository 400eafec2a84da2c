#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/robust.h"
#include "model/homing.h"

namespace halyard {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kChange_s = 0.5;  ///< between two samples whose change is compared: longer than delays and vibrations

/// Slope of joint k's reading over its expectation, or, if that explains more, of the reading plus coupling over what
/// its own motor gives. The first suits a wrong reading; the second a wrong motor, whose coupling is right.
Slope slope_at(const SampledMotion& m, int k) {
  const double longest = 0.25 * m.step * static_cast<double>(m.time.size());
  const auto change = static_cast<std::size_t>(std::max(1.0, std::min(kChange_s, longest) / m.step));
  std::vector<double> of_cable = m.joint[k];
  for (std::size_t i = 0; i < of_cable.size(); ++i) of_cable[i] += m.own[k][i] - m.expected[k][i];
  const Slope joint = slope_of(m.joint[k], m.expected[k], change);
  if (spread(m.own[k]) < 1e-6 * spread(of_cable)) return joint;  // the motor does not move
  const Slope cable = slope_of(of_cable, m.own[k], change);
  return cable.explained > joint.explained ? cable : joint;
}

bool is_near(double ratio, double expected, double within) {
  return ratio * expected > 0 && std::abs(std::log(ratio / expected)) < std::log(within);
}

bool moves(const LogUnderCheck& c, int k, const std::vector<double>& position) {
  return spread(position) > c.rule.least_motion * c.range(k);
}

/// An explanation of a slope: which of two columns is wrong, and by what factor.
struct Explanation {
  Signals Log::*signal;
  UnitGuess unit;
  double misfit;  ///< smaller is better
};

/// Explanations of |slope| by a unit of either column, by a scale of its map that it should not have, or by a motor's
/// angle that is not one at its shaft.
std::optional<Explanation> unit_that_explains(const LogUnderCheck& c, const SampledMotion& m, int k, double slope) {
  constexpr double kCoincidence = 0.5;  // that a scale of the map is exactly what is too much
  const JointParameters<double>& j = c.model.nominal.joint[k];
  std::optional<Explanation> best;
  const double joint_beyond = c.beyond_range(k, m.joint[k], j.joint_zero_known);
  const double motor_beyond = c.beyond_range(k, m.expected[k], j.motor_zero_known);
  const auto undone = [&](Signals Log::*signal) { return 1 / c.scale_of(column_name(signal, k)); };
  const auto try_one = [&](Signals Log::*signal, const UnitGuess& unit) {
    // The reading has 1 / factor of its size, or its expectation has.
    const double expected = signal == &Log::joint_position ? 1 / unit.factor : unit.factor;
    if (is_near(expected, 1, c.rule.ratio) || !is_near(std::abs(slope), expected, c.rule.unit)) return;
    const double misfit = std::abs(std::log(std::abs(slope) / expected)) / std::log(c.rule.unit) +
                          (signal == &Log::joint_position ? motor_beyond : joint_beyond) +
                          (unit.factor == undone(signal) ? 0 : kCoincidence);
    if (!best || misfit < best->misfit) best = {signal, unit, misfit};
  };
  for (const UnitGuess& unit : position_units(j.type == JointType::prismatic, j.joint_encoder_resolution))
    try_one(&Log::joint_position, unit);
  std::vector<UnitGuess> of_motor = position_units(false, j.motor_encoder_resolution);
  of_motor.push_back({"", j.gear_ratio, "the angle behind the gear"});
  of_motor.push_back({"", 1 / c.joint_per_motor(k), "the joint's own position"});
  for (const UnitGuess& unit : of_motor) try_one(&Log::motor_position, unit);
  for (const auto signal : {&Log::joint_position, &Log::motor_position})
    try_one(signal, {"", undone(signal), "in SI units before its column map converts it"});
  return best;
}

/// How badly joint k's reading agrees with its expectation; infinite if it does not at all.
double disagreement(const LogUnderCheck& c, const SampledMotion& m, int k, double least_explained) {
  const JointParameters<double>& j = c.model.nominal.joint[k];
  const Slope s = slope_at(m, k);
  if (s.explained < least_explained || !is_near(s.slope, 1, c.rule.ratio)) return kInfinity;
  double sum = std::abs(std::log(s.slope)) + (1 - s.explained);
  if (j.joint_zero_known && j.motor_zero_known && c.range(k) > 0)
    sum += std::abs(median(m.joint[k]) - median(m.expected[k])) / c.range(k);
  return sum;
}

/// Swaps motors or joints i and j if that makes both readings agree with the model.
bool check_swap(LogUnderCheck& c, const SampledMotion& m, int i, int j) {
  for (const int k : {i, j}) {
    if (m.joint[k].empty() || m.expected[k].empty()) return false;
    if (!moves(c, k, m.joint[k]) && !moves(c, k, m.expected[k])) return false;
    if (disagreement(c, m, k, c.rule.explained) < kInfinity) return false;
  }
  double best = kInfinity;
  Signals Log::*which = nullptr;
  for (const auto signal : {&Log::motor_position, &Log::joint_position}) {
    LogUnderCheck swapped = c;
    swapped.swap(signal, i, j);
    home_encoders(swapped.log, c.model);
    const SampledMotion motion = sampled_motion(swapped.log, c.model);
    const double left = disagreement(swapped, motion, i, c.rule.explained_by_swap) +
                        disagreement(swapped, motion, j, c.rule.explained_by_swap);
    if (left < best) best = left, which = signal;
  }
  if (!which) return false;
  const std::string a = column_name(which, i), b = column_name(which, j);
  c.reject(
      a,
      fmt::format("seems to be exchanged with {}: joint {}'s reading follows motor {}, and the reverse; expected its "
                  "own motor",
                  b, i + 1, j + 1),
      "exchange them with " + c.swap_options(a, b));
  c.swap(which, i, j);
  home_encoders(c.log, c.model);
  return true;
}

void check_ratio(LogUnderCheck& c, const SampledMotion& m, int k, const Slope& s) {
  const std::string motor = column_name(&Log::motor_position, k), joint = column_name(&Log::joint_position, k);
  const std::string seen =
      fmt::format("joint {} moves {:.4g} times as far as motor {} says (slope; expected 1 within a factor of {:g})",
                  k + 1, std::abs(s.slope), k + 1, c.rule.ratio);
  if (const auto unit = unit_that_explains(c, m, k, s.slope)) {
    const Correction correction{.unit_factor = unit->unit.factor};
    const std::string name = column_name(unit->signal, k);
    c.reject(name, seen + ", as if it were " + unit->unit.what, "read it with " + c.option(name, correction));
    c.correct(unit->signal, k, correction);
    return;
  }
  const Correction correction{.unit_factor = 1 / std::abs(s.slope)};
  const std::string remedy =
      fmt::format("correct gear_ratio, capstan_radius or pulley_radius of joint {} in the model, or read it with {}",
                  k + 1, c.option(joint, correction));
  if (is_near(std::abs(s.slope), 1, c.rule.gross_ratio)) c.suspect(joint, seen, remedy);
  else c.reject(joint, seen + ", which no unit explains", remedy);
  c.correct(&Log::joint_position, k, correction);
}

/// The correction of a reversed joint reading: about zero, or about where the motors say.
Correction reversed(const LogUnderCheck& c, const SampledMotion& m, int k) {
  std::vector<double> off;
  for (std::size_t i = 0; i < m.time.size(); ++i) off.push_back(m.expected[k][i] + m.joint[k][i]);
  const double offset = median(off);
  const bool known = c.model.nominal.joint[k].joint_zero_known && c.model.nominal.joint[k].motor_zero_known;
  return {.factor = -1, .offset = known && std::abs(offset) > c.rule.least_motion * c.range(k) ? offset : 0};
}

void check_sign(LogUnderCheck& c, int k, const Slope& s, int torque_sense) {
  const SampledMotion m = sampled_motion(c.log, c.model);
  const JointParameters<double>& j = c.model.nominal.joint[k];
  const double joint_beyond = c.beyond_range(k, m.joint[k], j.joint_zero_known);
  const double motor_beyond = c.beyond_range(k, m.expected[k], j.motor_zero_known);
  const bool motor = torque_sense != 0 ? torque_sense < 0 : motor_beyond > joint_beyond + c.rule.outside;
  const bool told = torque_sense != 0 || std::abs(motor_beyond - joint_beyond) > c.rule.outside;
  const auto signal = motor ? &Log::motor_position : &Log::joint_position;
  const Correction correction = motor ? Correction{.factor = -1} : reversed(c, m, k);
  const std::string name = column_name(signal, k),
                    other = column_name(motor ? &Log::joint_position : &Log::motor_position, k);
  c.reject(name,
           fmt::format("is reversed: joint {} moves against its motor (slope {:.3g}, expected 1){}", k + 1, s.slope,
                       torque_sense < 0   ? ", and the motor's torque opposes this motion"
                       : torque_sense > 0 ? ", while the motor's torque agrees with the motor's motion"
                       : told             ? fmt::format(", and {} is within the joint's range", other)
                                          : ""),
           "read it with " + c.option(name, correction) +
               (told ? "" : ", or reverse " + other + " with " + c.option(other, Correction{.factor = -1})));
  c.correct(signal, k, correction);
}

/// A motor without a sensor at its joint: its motion must fit into the joint's range.
void check_range_of_motion(LogUnderCheck& c, const SampledMotion& m, int k) {
  const JointParameters<double>& j = c.model.nominal.joint[k];
  if (spread(m.expected[k]) < c.rule.gross_ratio * c.range(k) || !(c.range(k) > 0)) return;
  const std::string name = column_name(&Log::motor_position, k);
  std::vector<UnitGuess> units = position_units(false, j.motor_encoder_resolution);
  std::string guess = "in another unit";
  Correction correction{.unit_factor = c.range(k) / (2 * spread(m.expected[k]))};
  constexpr double kLeastUsed = 0.2;  // of the range: a unit that leaves less of the motion is not the reason
  double best = kInfinity;
  for (const UnitGuess& unit : units) {
    std::vector<double> corrected = m.expected[k];
    for (double& q : corrected) q *= unit.factor;
    const double used = spread(corrected) / c.range(k);
    if (used < kLeastUsed || used > c.rule.gross_ratio) continue;
    // Of several units that fit into the range the one that moves most is the likeliest.
    const double misfit =
        c.beyond_range(k, corrected, j.motor_zero_known && j.motor_encoder_offset == 0) - 0.1 * std::min(1.0, used);
    if (misfit < best) best = misfit, guess = "in " + unit.what, correction.unit_factor = unit.factor;
  }
  c.reject(name,
           fmt::format("moves joint {} by {:.3g}, {:.3g} times its range, as if the angle were {}; expected rad at the "
                       "motor shaft",
                       k + 1, spread(m.expected[k]), spread(m.expected[k]) / c.range(k), guess),
           "read it with " + c.option(name, correction));
  c.correct(&Log::motor_position, k, correction);
}

/// A joint that moves, and a motor that moves, without any relation.
void check_relation(LogUnderCheck& c, const SampledMotion& m, int k) {
  const std::string motor = column_name(&Log::motor_position, k), joint = column_name(&Log::joint_position, k);
  if (!moves(c, k, m.joint[k]) || !moves(c, k, m.expected[k])) return;
  if (c.has_finding(motor) || c.has_finding(joint) || slope_at(m, k).explained >= c.rule.unrelated) return;
  c.suspect(joint, fmt::format("does not follow {}: both move, and without any relation", motor),
            "check whether each is the column of this joint, and not of another one");
}

}  // namespace

void check_positions(LogUnderCheck& c) {
  SampledMotion m = sampled_motion(c.log, c.model);
  for (int i = 0; i < c.n(); ++i)
    for (int j = i + 1; j < c.n(); ++j)
      if (check_swap(c, m, i, j)) m = sampled_motion(c.log, c.model);
  std::vector<std::pair<int, Slope>> reversed_joints;
  // From the base outward: a joint's expected reading depends on the motors inboard.
  for (int k = 0; k < c.n(); ++k) {
    if (m.expected[k].empty()) continue;
    const bool has_sensor = !m.joint[k].empty() && spread(m.joint[k]) > 0;
    Slope s;
    if (has_sensor && (moves(c, k, m.joint[k]) || moves(c, k, m.expected[k]))) s = slope_at(m, k);
    if (s.explained >= c.rule.explained) {
      if (!is_near(std::abs(s.slope), 1, c.rule.ratio)) check_ratio(c, m, k, s);
      if (s.slope < 0) reversed_joints.emplace_back(k, s);
    } else {
      check_range_of_motion(c, m, k);
      if (has_sensor) check_relation(c, m, k);
    }
    m = sampled_motion(c.log, c.model);
  }
  if (reversed_joints.empty()) return;
  const std::vector<int> senses = torque_senses(c);
  for (const auto& [k, s] : reversed_joints) check_sign(c, k, s, senses[k]);
}

}  // namespace halyard

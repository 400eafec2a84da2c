#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "diagnosis/log_check/agreement.h"
#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/robust.h"
#include "model/statistics/quantile.h"

namespace halyard {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A joint's reading that is no position of the joint in any unit: nothing more is concluded from it.
void reject_reading(LogUnderCheck& c, int k, const std::string& seen) {
  c.reject(column_name(&Log::joint_position, k), seen + ", which no unit explains",
           fmt::format("say which columns of the file these are, with --column joint_position_{0}=NAME or --column "
                       "motor_position_{0}=NAME; if one counts the steps of its encoder, state the encoder's "
                       "resolution in <encoders> of joint {0}",
                       k + 1));
  c.log.joint_position[k].clear();
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
  if (!is_near(std::abs(s.slope), 1, c.rule.most_ratio)) return reject_reading(c, k, seen);
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

bool is_too_wide(const LogUnderCheck& c, int k, const std::vector<double>& position) {
  return c.range(k) > 0 && spread(position) >= c.rule.gross_ratio * c.range(k);
}

/// The unit in which a motion fits into the range of joint k.
std::optional<UnitGuess> unit_that_fits(const LogUnderCheck& c, int k, const std::vector<double>& position,
                                        const std::vector<UnitGuess>& units, bool zero_known) {
  constexpr double kLeastUsed = 0.2;  // of the range: a unit that leaves less of the motion is not the reason
  std::optional<UnitGuess> fits;
  double best = kInfinity;
  for (const UnitGuess& unit : units) {
    std::vector<double> corrected = position;
    for (double& q : corrected) q *= unit.factor;
    const double used = spread(corrected) / c.range(k);
    if (used < kLeastUsed || used > c.rule.gross_ratio) continue;
    // Of several units that fit into the range the one that moves most is the likeliest.
    const double misfit = c.beyond_range(k, corrected, zero_known) - 0.1 * std::min(1.0, used);
    if (misfit < best) best = misfit, fits = unit;
  }
  return fits;
}

std::string times_its_range(const LogUnderCheck& c, int k, const std::vector<double>& position) {
  return fmt::format("{}, {:.3g} times its range", c.position(k, spread(position)), spread(position) / c.range(k));
}

/// The motion of a motor must fit into the range of its joint. If the joint has a sensor that agrees, the motor may be
/// right, and the range wrong.
void check_range_of_motion(LogUnderCheck& c, const SampledMotion& m, int k, bool sensor_agrees) {
  if (!is_too_wide(c, k, m.expected[k])) return;
  const std::string name = column_name(&Log::motor_position, k);
  const JointParameters<double>& j = c.model.nominal.joint[k];
  const std::optional<UnitGuess> unit =
      unit_that_fits(c, k, m.expected[k], position_units(false, j.motor_encoder_resolution),
                     j.motor_zero_known && j.motor_encoder_offset == 0);
  const std::string seen = fmt::format("moves joint {} by {}", k + 1, times_its_range(c, k, m.expected[k]));
  if (!unit && sensor_agrees)
    return c.suspect(name, seen + ", and so does its sensor",
                     fmt::format("correct the range of joint {} in the model, or give both columns their unit", k + 1));
  // A factor that only fits would hide what is wrong.
  const Correction correction{.unit_factor = unit ? unit->factor : c.range(k) / (2 * spread(m.expected[k]))};
  const std::string remedy = unit ? "read it with " + c.option(name, correction)
                                  : fmt::format(
                                        "give the column its unit, or a scale that you know, by --column {0}=NAME, "
                                        "or correct the range of joint {1} in the model",
                                        name, k + 1);
  c.reject(name,
           fmt::format("{}, as if the angle were {}; expected rad at the motor shaft", seen,
                       unit ? "in " + unit->what : "in another unit"),
           remedy);
  c.correct(&Log::motor_position, k, correction);
}

/// The reading of a joint without a motor can be compared with the joint's range alone.
void check_undriven(LogUnderCheck& c, const SampledMotion& m, int k) {
  const JointParameters<double>& j = c.model.nominal.joint[k];
  const std::string name = column_name(&Log::joint_position, k);
  if (!(c.range(k) > 0) || m.joint[k].empty()) return;
  if (is_too_wide(c, k, m.joint[k])) {
    const std::string seen = "moves by " + times_its_range(c, k, m.joint[k]);
    const std::optional<UnitGuess> unit =
        unit_that_fits(c, k, m.joint[k], position_units(j.type == JointType::prismatic, j.joint_encoder_resolution),
                       j.joint_zero_known);
    if (!unit)
      return c.suspect(name, seen,
                       fmt::format("correct the range of joint {} in the model, or give the column its unit", k + 1));
    const Correction correction{.unit_factor = unit->factor};
    c.reject(name, seen + ", as if it were in " + unit->what, "read it with " + c.option(name, correction));
    return c.correct(&Log::joint_position, k, correction);
  }
  const double level = median(m.joint[k]);
  if (!j.joint_zero_known || c.beyond_range(k, {level}, true) <= c.rule.outside) return;
  const bool is_mirrored = c.beyond_range(k, {-level}, true) <= c.rule.outside;
  c.suspect(
      name,
      fmt::format("is {} in the median, outside the joint's range, {}", c.position(k, level), c.range_in_words(k)),
      "check the sign and the zero of this column, or the range in the model" +
          (is_mirrored ? "; within the range with " + c.option(name, Correction{.factor = -1}) : ""));
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
  std::vector<std::pair<int, Slope>> reversed_joints;
  // From the base outward: a joint's expected reading depends on the motors inboard.
  for (int k = 0; k < c.n(); ++k) {
    if (!c.is_driven(k)) {
      check_undriven(c, m, k);
      m = sampled_motion(c.log, c.model);
      continue;
    }
    if (m.expected[k].empty()) continue;
    const bool has_sensor = !m.joint[k].empty() && spread(m.joint[k]) > 0;
    // Both in the same wrong unit agree with each other.
    if (has_sensor && is_too_wide(c, k, m.joint[k]) && is_too_wide(c, k, m.expected[k])) {
      check_range_of_motion(c, m, k, true);
      m = sampled_motion(c.log, c.model);
    }
    Slope s;
    if (has_sensor && (moves(c, k, m.joint[k]) || moves(c, k, m.expected[k]))) s = slope_at(m, k);
    if (s.explained >= c.rule.explained) {
      if (!is_near(std::abs(s.slope), 1, c.rule.ratio)) check_ratio(c, m, k, s);
      if (s.slope < 0 && !c.log.joint_position[k].empty()) reversed_joints.emplace_back(k, s);
    } else {
      check_range_of_motion(c, m, k, false);
      if (has_sensor) check_relation(c, m, k);
    }
    m = sampled_motion(c.log, c.model);
  }
  if (reversed_joints.empty()) return;
  const std::vector<int> senses = torque_senses(c);
  for (const auto& [k, s] : reversed_joints) check_sign(c, k, s, senses[k]);
}

}  // namespace halyard

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "diagnosis/calibration/lateness.h"
#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/robust.h"
#include "diagnosis/record/record.h"
#include "diagnosis/record/sampled_column.h"
#include "model/homing.h"
#include "model/input_error.h"
#include "model/statistics/quantile.h"
#include "transmission/effect.h"

namespace halyard {
namespace {

double beyond(const LogUnderCheck& c, int k, double level) { return c.beyond_range(k, {level}, true); }

/// Median of the joint's reading less its expectation, over the instants that have both; NaN if there are none.
double median_mismatch(const SampledMotion& m, int k) {
  std::vector<double> off;
  for (std::size_t i = 0; i < std::min(m.joint[k].size(), m.expected[k].size()); ++i)
    if (const double o = m.joint[k][i] - m.expected[k][i]; std::isfinite(o)) off.push_back(o);
  return off.empty() ? std::numeric_limits<double>::quiet_NaN() : median(off);
}

/// The offset of a motor without a sensor at its joint: between which numbers its motion fits into the joint's range.
std::string offset_that_fits(const LogUnderCheck& c, const std::vector<double>& expected, int k) {
  const std::string motor = column_name(&Log::motor_position, k);
  const double per_motor = c.joint_per_motor(k), of_map = c.offset_of(motor);
  const double up_to_lower = c.model.joints[k].lower - quantile(expected, 0);
  const double up_to_upper = c.model.joints[k].upper - quantile(expected, 1);
  const std::string middle = c.option(motor, Correction{.offset = 0.5 * (up_to_lower + up_to_upper) / per_motor});
  if (up_to_lower > up_to_upper)
    return "the motion is wider than the range; its middle is in that of the range with " + middle;
  const auto [first, last] = std::minmax({up_to_lower / per_motor, up_to_upper / per_motor});
  return fmt::format(
      "the motion fits into the range with an offset of {:.4g} to {:.4g} rad: hold the joint at a known position to "
      "measure it, or begin with the middle, {}",
      of_map + first, of_map + last, middle);
}

/// What the reading of motor k lacks by the sensors of the joints, as homing finds it; nothing if they do not tell.
std::optional<double> zero_of_motor(const LogUnderCheck& c, int k) {
  ArmModel unknown = c.model;
  for (int j = 0; j < c.n(); ++j) unknown.nominal.joint[j].motor_zero_known = j != k;
  Log homed = c.log;
  try {
    home_encoders(homed, unknown);
  } catch (const InputError&) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < homed.size(); ++i)
    if (const double x = homed.motor_position[k][i] - c.log.motor_position[k][i]; std::isfinite(x)) return x;
  return std::nullopt;
}

/// Upper bound of a parameter of an effect.
double reach_of(const LogUnderCheck& c, const char* effect, const std::string& parameter, int k) {
  const auto parameters = find_effect(effect)->parameters(c.model.nominal, k);
  return std::ranges::find(parameters, parameter, &EffectParameter::name)->upper;
}

/// How far a zero may be off without being told: an effect may explain it.
double allowed_offset(const LogUnderCheck& c, int k) {
  return std::min(c.rule.zero * c.range(k), reach_of(c, "encoder_offset", "offset", k));
}

/// Of a joint whose motor's zero is taken from this very sensor: only the joint's range can tell that it is wrong.
void check_zero_of_reference(LogUnderCheck& c, const SampledMotion& m, int k) {
  const double read = median(m.joint[k]);
  if (beyond(c, k, read) > c.rule.outside)
    c.suspect(
        column_name(&Log::joint_position, k),
        fmt::format("is {} in the median, outside the joint's range, {}", c.position(k, read), c.range_in_words(k)),
        "check the zero of this column, and whether it is that of another joint, or correct the range in the "
        "model: the motor's unknown zero is taken from it");
}

void check_zero(LogUnderCheck& c, const SampledMotion& m, int k) {
  const JointParameters<double>& j = c.model.nominal.joint[k];
  if (j.joint_zero_known && !j.motor_zero_known) check_zero_of_reference(c, m, k);
  if (!(c.range(k) > 0) || m.expected[k].empty()) return;
  const std::string motor = column_name(&Log::motor_position, k), joint = column_name(&Log::joint_position, k);
  const double expected = median(m.expected[k]), off = median_mismatch(m, k);
  const auto to_motor = [&] {
    const std::optional<double> zero = zero_of_motor(c, k);
    return zero ? ", or correct its zero with " + c.option(motor, Correction{.offset = *zero}) : "";
  };
  if (std::isfinite(off) && j.joint_zero_known && j.motor_zero_known) {
    const double read = median(m.joint[k]);
    const bool reading_out = beyond(c, k, read) > c.rule.outside && beyond(c, k, expected) <= c.rule.outside;
    const bool motor_out = beyond(c, k, expected) > c.rule.outside && beyond(c, k, read) <= c.rule.outside;
    if (motor_out)
      return c.suspect(motor,
                       fmt::format("puts joint {} at {} in the median; its sensor says {}, its range is {}", k + 1,
                                   c.position(k, expected), c.position(k, read), c.range_in_words(k)),
                       fmt::format("state motor_offset=\"unknown\" in <encoders> of joint {}, as of a counter that "
                                   "starts where it is switched on{}",
                                   k + 1, to_motor()));
    if (reading_out || std::abs(off) > allowed_offset(c, k))
      return c.suspect(
          joint,
          fmt::format("is {} in the median where the motors say {}; the joint's range is {}", c.position(k, read),
                      c.position(k, expected), c.range_in_words(k)),
          fmt::format("if its zero is wrong, state joint_offset=\"unknown\" in <encoders> of joint {}, or correct it "
                      "with {}; if the motor's is, state motor_offset=\"unknown\" there{}",
                      k + 1, c.option(joint, Correction{.offset = -off}), to_motor()));
  }
  if (beyond(c, k, expected) > c.rule.outside && j.motor_zero_known)
    c.suspect(motor,
              fmt::format("puts joint {} at {} in the median, outside its range, {}", k + 1, c.position(k, expected),
                          c.range_in_words(k)),
              "check the sign and the zero of this column, or the range in the model; " +
                  offset_that_fits(c, m.expected[k], k));
}

/// A counter that starts again does not say in which lap a log begins; the joint's own reading does. A mismatch within
/// the rule for zeros may be an effect, too: of a wrong ratio or zero.
void check_lap(LogUnderCheck& c, int k) {
  const JointParameters<double>& j = c.model.nominal.joint[k];
  const std::string motor = column_name(&Log::motor_position, k), joint = column_name(&Log::joint_position, k);
  const double of_motor = c.wrap_of(motor), of_joint = c.wrap_of(joint);
  if ((of_motor == 0) == (of_joint == 0) || !j.joint_zero_known || !j.motor_zero_known) return;
  const double off = median_mismatch(sampled_motion(c.log, c.model), k), period = of_motor + of_joint;
  const double laps = std::round((of_motor > 0 ? off / c.joint_per_motor(k) : -off) / period);
  if (!(std::abs(laps) >= 1)) return;
  const Correction correction{.offset = laps * period};
  const bool is_motor = of_motor > 0, is_gross = std::abs(off) > allowed_offset(c, k);
  const std::string what =
      fmt::format("begins {:g} lap{} of its counter from where {} says{}", std::abs(laps),
                  std::abs(laps) > 1 ? "s" : "", is_motor ? joint : motor,
                  is_gross ? "; expected the same lap" : "; a wrong ratio or zero of the arm would look the same");
  const std::string remedy = fmt::format(
      "correct it with {}, or, if each log begins in another lap, state {}_offset=\"unknown\" in <encoders> "
      "of joint {}",
      c.option(is_motor ? motor : joint, correction), is_motor ? "motor" : "joint", k + 1);
  if (!is_gross) return c.suspect(is_motor ? motor : joint, what, remedy);
  c.reject(is_motor ? motor : joint, what, remedy);
  c.correct(is_motor ? &Log::motor_position : &Log::joint_position, k, correction);
}

/// Mismatch of a joint's reading with its expectation a time earlier, less a slope and a mean: Σ e² / samples. Infinite
/// with fewer than ten samples, or if nothing moves.
double mismatch(const SampledMotion& m, const SampledColumn& reading, int k, double late) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < m.time.size(); ++i) {
    const double t = m.time[i] + late, p = m.expected[k][i];
    if (!std::isfinite(p) || t < m.time.front() || t > m.time.back() || !std::isfinite(m.joint[k][i])) continue;
    const double q = reading.at(t);
    n += 1, x += p, y += q, xx += p * p, xy += p * q, yy += q * q;
  }
  if (n < 10 || n * xx <= x * x) return std::numeric_limits<double>::infinity();
  const double cxx = xx - x * x / n, cxy = xy - x * y / n, cyy = yy - y * y / n;
  return std::max(0.0, cyy - cxy * cxy / cxx) / n;
}

/// A shift in time, s, and the mismatch that it leaves.
struct Shift {
  double late = 0, left = 0;

  void try_from(double from, double to, double step, const SampledMotion& m, const SampledColumn& reading, int k) {
    for (double t = from; t <= to; t += step)
      if (const double e = mismatch(m, reading, k, t); e < left) left = e, late = t;
  }
};

void check_delay(LogUnderCheck& c, const SampledMotion& m, int k) {
  if (m.expected[k].empty() || m.joint[k].empty()) return;
  if (spread(m.expected[k]) < c.rule.least_motion * c.range(k)) return;
  const bool slow = has_slow_joint_sensor(c.log, c.model, k);
  const SampledColumn reading(c.log.time, c.log.joint_position[k]), motor(c.log.time, c.log.motor_position[k]);
  const double interval = std::max(reading.interval(), motor.interval());
  // A diagnosis measures the lag of slow sensors better, and takes it out, up to a limit.
  const double least = std::max(slow ? kLongestLateness : c.rule.late_s, c.rule.late_samples * interval);
  const double at_zero = mismatch(m, reading, k, 0);
  if (!std::isfinite(at_zero)) return;
  Shift best{.left = at_zero};
  const double longest = std::min(0.5, 0.1 * c.log.duration());
  const double step = std::max(1e-3, least / 6);
  best.try_from(-longest, longest, step, m, reading, k);
  if (slow) best.try_from(best.late - step, best.late + step, 1e-3, m, reading, k);
  if (std::abs(best.late) <= least || best.left > (1 - c.rule.late_explains) * at_zero) return;
  const double longest_delay = reach_of(c, "delay", "sensor_delay", k);
  c.suspect(
      column_name(&Log::joint_position, k),
      fmt::format("is {:.3g} ms {} motor_position_{}; the shift removes {:.0f} % of the squared mismatch",
                  1e3 * std::abs(best.late), best.late > 0 ? "late against" : "ahead of", k + 1,
                  100 * (1 - best.left / at_zero)),
      slow ? fmt::format("correct the times of this column: a diagnosis measures and takes out at most {:g} s",
                         kLongestLateness)
      : std::abs(best.late) > longest_delay
          ? fmt::format("record both with one clock, or move the readings of this column by {:.4g} s in the file: "
                        "the effect delay reaches {:g} s at most",
                        -best.late, longest_delay)
          : "record both with one clock; the diagnosis takes a constant lag out if the sensor is slower than "
            "its motor's, and names it as the effect delay otherwise");
}

}  // namespace

void check_zeros(LogUnderCheck& c) {
  for (int k = 0; k < c.n(); ++k) check_lap(c, k);
  const SampledMotion m = sampled_motion(c.log, c.model);
  for (int k = 0; k < c.n(); ++k) check_zero(c, m, k);
}

void check_delays(LogUnderCheck& c) {
  const SampledMotion m = sampled_motion(c.log, c.model);
  for (int k = 0; k < c.n(); ++k) check_delay(c, m, k);
}

}  // namespace halyard

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/exchanges/exchanges.h"
#include "diagnosis/log_check/robust.h"
#include "diagnosis/log_check/torques/needed_torques.h"
#include "diagnosis/log_check/torques/saturating_torque.h"
#include "diagnosis/prediction/room.h"
#include "model/statistics/quantile.h"

namespace halyard {
namespace {

/// Without a sensor at the joint, the torque's or the motor angle's sign may be wrong: the joint's range tells which.
void check_torque_sign(LogUnderCheck& c, const SampledMotion& m, int k, const Correlation& r) {
  const JointParameters<double>& j = c.model.nominal.joint[k];
  const std::string torque = column_name(&Log::motor_torque, k), motor = column_name(&Log::motor_position, k);
  const std::string seen = fmt::format(
      "the recorded torque opposes the torque that the motor's motion requires (correlation {:.2f} while it moves; "
      "expected a positive one)",
      r.r);
  const std::string torque_remedy = "reverse it with " + c.option(torque, Correction{.factor = -1});
  const std::string motor_remedy = c.option(motor, Correction{.factor = -1});
  if (!c.log.joint_position[k].empty()) {
    c.reject(torque, seen, torque_remedy);
    return c.correct(&Log::motor_torque, k, {.factor = -1});
  }
  std::vector<double> reversed = m.expected[k];
  for (double& q : reversed) q = -q;
  const bool zero_known = j.motor_zero_known && j.motor_encoder_offset == 0;
  const double as_is = c.beyond_range(k, m.expected[k], zero_known), turned = c.beyond_range(k, reversed, zero_known);
  if (as_is > turned + c.rule.outside) {
    c.reject(motor, fmt::format("is reversed: {}, and the joint would be outside its range", seen),
             "reverse it with " + motor_remedy);
    return c.correct(&Log::motor_position, k, {.factor = -1});
  }
  const bool told = turned > as_is + c.rule.outside;
  c.reject(torque, seen, torque_remedy + (told ? "" : ", or the motor's angle with " + motor_remedy));
  c.correct(&Log::motor_torque, k, {.factor = -1});
}

/// True if a motor that saturates explains the required torque significantly better than a factor of about `unit`.
bool saturates(const LogUnderCheck& c, const TorqueComparison& t, int k, double unit, const Correlation& r) {
  const double independent = static_cast<double>(r.n) * t.step / c.rule.independent_s;
  return evidence_of_saturation(t.recorded[k], t.needed[k], unit / c.rule.torque_unit, unit * c.rule.torque_unit,
                                independent) > 0.5 * c.rule.significance * c.rule.significance;
}

/// True if the recorded torque stops at the torque_limit of the model's controller. In another unit it would stop
/// elsewhere.
bool stops_at_limit_of_model(const LogUnderCheck& c, int k) {
  const double limit = c.model.joints[k].controller.torque_limit;
  std::vector<double> size = c.log.motor_torque[k];
  for (double& x : size) x = std::abs(x);
  // From the share of samples that counts as clipped up to all but a tenth of them.
  for (const double beyond : {c.rule.clipped, 0.1 * c.rule.clipped})
    if (!(limit > 0) || !(std::abs(quantile(size, 1 - beyond) / limit - 1) < c.rule.at_limit)) return false;
  return true;
}

/// Why the size of a torque is no matter of its unit, if so.
std::string not_of_unit(const LogUnderCheck& c, const TorqueComparison& t, int k, double unit, const Correlation& r) {
  if (stops_at_limit_of_model(c, k)) return ", but it stops at the model's torque_limit, as in the right unit";
  if (saturates(c, t, k, unit, r)) return ", but about the recorded torque where that is small";
  return "";
}

void check_torque_unit(LogUnderCheck& c, const TorqueComparison& t, int k, const Correlation& r) {
  if (r.r < c.rule.torque_goes_with || !has_known_scale(c, k)) return;
  if (std::abs(std::log(r.size)) < std::log(c.rule.torque_ratio)) return;
  const double gear = c.model.nominal.joint[k].gear_ratio;
  const std::vector<UnitGuess> units = {{"mN.m", 1e-3, "mN m"},
                                        {"", 1 / gear, "the torque behind the gear"},
                                        {"", gear, "the torque at the motor times the ratio's inverse"},
                                        {"", 1e3, "kN m"},
                                        {"", 1e-2, "N cm"}};
  const auto misfit = [&](const UnitGuess& u) { return std::abs(std::log(r.size / u.factor)); };
  const UnitGuess best = *std::ranges::min_element(units, {}, misfit);
  const std::string torque = column_name(&Log::motor_torque, k);
  const std::string seen = fmt::format(
      "the motion requires {:.3g} times the recorded torque (expected 1 within a factor "
      "of {:g})",
      r.size, c.rule.torque_ratio);
  if (c.is_electric(torque) && c.model.nominal.joint[k].torque_scale == 1)
    return c.reject(torque, seen + "; the column is in A or V, and no scale to N m is known",
                    fmt::format("give the motor's torque constant (N m per A, or per V of the amplifier) as scale= of "
                                "this column, or state torque_scale=\"1\" in <tolerances> of joint {} and have it "
                                "estimated",
                                k + 1));
  const std::string current =
      fmt::format("if it is a current or a voltage, state torque_scale=\"1\" in <tolerances> of joint {}", k + 1);
  if (misfit(best) > std::log(c.rule.torque_unit))
    return c.suspect(torque, seen, "give the column its unit or scale; " + current);
  if (const std::string why = not_of_unit(c, t, k, best.factor, r); !why.empty())
    return c.suspect(torque, seen + why, "nothing to do if the motor saturates below its command");
  const Correction correction{.unit_factor = best.factor};
  c.reject(torque, seen + ", as if it were " + best.what,
           "read it with " + c.option(torque, correction) + "; " + current);
  c.correct(&Log::motor_torque, k, correction);
}

}  // namespace

std::vector<int> torque_senses(const LogUnderCheck& c) {
  std::vector<int> senses(c.n(), 0);
  const auto t = needed_torques(c);
  for (int k = 0; t && k < c.n(); ++k) {
    const double r = significant(c, *t, k, k).r;
    senses[k] = r < c.rule.torque_opposes ? -1 : r > -c.rule.torque_opposes ? 1 : 0;
  }
  return senses;
}

void check_torques(LogUnderCheck& c) {
  auto t = needed_torques(c);
  if (t && !t->is_predicted)
    return c.suspect("motor_torque",
                     "was not compared with what the motion requires, because the model cannot be integrated along it" +
                         fastest_state(c.model),
                     "take larger smoothing speeds, or less damping, in the model");
  if (t && check_torque_exchanges(c, *t)) t = needed_torques(c);
  const SampledMotion m = sampled_motion(c.log, c.model);
  for (int k = 0; t && k < c.n(); ++k) {
    const Correlation r = significant(c, *t, k, k);
    if (r.r < c.rule.torque_opposes) check_torque_sign(c, m, k, r);
    else check_torque_unit(c, *t, k, r);
  }
}

}  // namespace halyard

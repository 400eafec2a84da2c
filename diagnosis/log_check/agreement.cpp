#include "diagnosis/log_check/agreement.h"

#include <algorithm>
#include <cmath>

#include "model/statistics/quantile.h"

namespace halyard {
namespace {

constexpr double kChange_s = 0.5;  ///< between two samples whose change is compared: longer than delays and vibrations

}  // namespace

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

double misfit_of_slope(const LogUnderCheck& c, double slope, double expected) {
  return std::abs(std::log(std::abs(slope) / expected)) / std::log(c.rule.unit);
}

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
    const double misfit = misfit_of_slope(c, slope, expected) +
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

double disagreement(const LogUnderCheck& c, const SampledMotion& m, int k, double least_explained) {
  const JointParameters<double>& j = c.model.nominal.joint[k];
  const Slope s = slope_at(m, k);
  if (s.explained < least_explained || !is_near(s.slope, 1, c.rule.ratio)) return kDisagrees;
  double sum = std::abs(std::log(s.slope)) + (1 - s.explained);
  if (j.joint_zero_known && j.motor_zero_known && c.range(k) > 0)
    sum += std::abs(median(m.joint[k]) - median(m.expected[k])) / c.range(k);
  return sum;
}

}  // namespace halyard

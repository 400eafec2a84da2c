#include "diagnosis/prediction/measured_units.h"

#include <algorithm>
#include <cmath>

#include "estimators/process/arm_dynamics.h"

namespace halyard {
namespace {

constexpr std::size_t kCommandStride = 4;  ///< samples; torques are band-limited

/// Running sums of a variance.
struct TorqueMoments {
  double n = 0, x = 0, xx = 0;
  void add(double value) { n += 1, x += value, xx += value * value; }
  double variance() const { return xx / n - (x / n) * (x / n); }
};

}  // namespace

double acting_over_commanded(const Record& record, const Hypothesis& h, int k, const CommandHistory& history) {
  constexpr double kLeast = 0.05;  // of the model's scale
  const double scale = std::abs(h.nominal.joint[k].torque_scale), least = kLeast * scale;
  const bool by_effect = std::ranges::any_of(h.effects, [](const PlacedEffect& e) {
    return (e.effect->stages() & static_cast<unsigned>(EffectStage::command)) != 0;
  });
  const Transmission<double> transmission = lift_transmission<double>(h.nominal, h.effects);
  if (!by_effect) return std::max(least, std::abs(transmission.arm().joint[k].torque_scale));
  const std::vector<double> z(kMaxStates, 0.0);
  TorqueMoments commanded, acting;
  for (std::size_t i = 0; i < record.size; i += kCommandStride) {
    JointSignals<double> s[kMaxJoints];
    for (int j = 0; j < record.n; ++j) {
      s[j].command = record.has_torque(j) ? record.torque[j][i] : 0.0;
      s[j].motor_angle = record.motor_angle[j][i];
      s[j].motor_rate = record.motor_rate[j][i];
    }
    transmission.commanded_torque(record.time(i), &history, z.data(), s);
    commanded.add(s[k].command);
    acting.add(s[k].motor_torque);
  }
  const double ratio = std::sqrt(acting.variance() / commanded.variance());
  return std::isfinite(ratio) ? std::max(least, ratio) : scale;
}

}  // namespace halyard

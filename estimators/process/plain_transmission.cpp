#include "estimators/process/plain_transmission.h"

namespace halyard {
namespace {

/// False if an effect does more than to add one constant to a signal.
bool take_effects(const Transmission<double>& transmission, const StateLayout& layout, PlainTransmission& plain) {
  constexpr unsigned kSensors = static_cast<unsigned>(EffectStage::sensors);
  int state = layout.effect_states;
  for (const EffectInstance<double>& e : transmission.effects()) {
    if (const auto* term = dynamic_cast<const ConstantTerm*>(e.effect)) {
      PlainTransmission::Constant& constant =
          (term->added_at() == EffectStage::stretch ? plain.stretch : plain.force)[*e.joint];
      if (constant.state >= 0) return false;
      constant = {state, term->factor()};
    } else if ((e.effect->stages() & ~kSensors) != 0 || e.effect->n_states() > 0) {
      return false;
    }
    state += e.effect->n_states();
  }
  return true;
}

}  // namespace

std::optional<PlainTransmission> plain_transmission(const Transmission<double>& transmission,
                                                    const StateLayout& layout) {
  PlainTransmission plain;
  for (int i = 0; i < PlainTransmission::kSpeeds; ++i) {
    plain.speed[i] = 0;
    plain.coulomb[i] = plain.viscous[i] = 0, plain.smoothing[i] = 1;
  }
  const ArmParameters<double>& arm = transmission.arm();
  for (int k = 0, n = arm.n; k < n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    if (j.drive != Drive::cable) return std::nullopt;
    plain.travel[k] = j.motor_travel();
    plain.per_rotor_inertia[k] = 1 / j.rotor_inertia;
    for (int i = 0; i < n; ++i) plain.path[k][i] = path_per_joint(j, i);
    plain.speed[k] = *layout.motor_rate[k], plain.speed[n + k] = layout.rate[k];
    plain.coulomb[k] = j.motor_coulomb, plain.coulomb[n + k] = j.joint_coulomb;
    plain.viscous[k] = j.motor_viscous, plain.viscous[n + k] = j.joint_viscous;
    plain.smoothing[k] = j.motor_smoothing, plain.smoothing[n + k] = j.joint_smoothing;
  }
  for (int i = 0; i < PlainTransmission::kSpeeds; ++i) plain.per_smoothing[i] = 1 / plain.smoothing[i];
  if (!take_effects(transmission, layout, plain)) return std::nullopt;
  return plain;
}

}  // namespace halyard

#include "estimators/process/plain/plain_transmission.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halyard {
namespace {

constexpr double kStraight = 1e-3;  // of the cable's force over the same stretch
constexpr EffectStage kStages[] = {EffectStage::command, EffectStage::stretch, EffectStage::cable_force,
                                   EffectStage::motor, EffectStage::joint};

bool acts_at(const Effect& effect, EffectStage stage) { return (effect.stages() & static_cast<unsigned>(stage)) != 0; }

int state_of(Signal signal, const StateLayout& l, int joint) {
  switch (signal) {
    case Signal::motor_angle: return *l.motor_angle[joint];
    case Signal::motor_rate: return *l.motor_rate[joint];
    case Signal::joint_position: return l.position[joint];
    case Signal::joint_rate: break;
  }
  return l.rate[joint];
}

/// False if the effect acts at a stage that has no terms.
bool take_terms(const Effect& effect, std::size_t index, EffectPlace place, const StateLayout& l,
                PlainTransmission& plain) {
  const auto* one = dynamic_cast<const OneSignalEffect*>(&effect);
  for (const EffectStage stage : kStages) {
    if (!acts_at(effect, stage)) continue;
    if (!one || !place || stage == EffectStage::command) return false;
    const int joint = *place;
    const EffectTerm term{index, stage, joint};
    if (stage == EffectStage::motor || stage == EffectStage::joint) {
      const Signal signal = one->signal_at(stage);
      plain.forces.push_back({term, signal, stage == EffectStage::motor ? joint : l.n_joints + joint,
                              state_of(signal, l, joint),
                              signal == Signal::motor_rate || signal == Signal::joint_rate});
    } else {
      plain.of_cable[joint].push_back(term);
      plain.has_kinks[joint] = plain.has_kinks[joint] || one->has_kinks();
    }
  }
  return true;
}

/// False if an effect is neither of one signal nor adds one constant to a signal.
bool take_effects(const Transmission<double>& transmission, const StateLayout& layout, PlainTransmission& plain) {
  int state = layout.effect_states;
  std::size_t index = 0;
  for (const EffectInstance<double>& e : transmission.effects()) {
    if (const auto* term = dynamic_cast<const ConstantTerm*>(e.effect)) {
      PlainTransmission::Constant& constant =
          (term->added_at() == EffectStage::stretch ? plain.stretch : plain.force)[*e.joint];
      if (constant.state >= 0) return false;
      constant = {state, term->factor()};
    } else if (e.effect->n_states() > 0 || !take_terms(*e.effect, index, e.joint, layout, plain)) {
      return false;
    }
    state += e.effect->n_states();
    ++index;
  }
  const auto rank = [&](const EffectTerm& t) {
    return std::pair(t.stage, transmission.effects()[t.effect].effect->rank(t.stage));
  };
  for (std::vector<EffectTerm>& terms : plain.of_cable) std::ranges::stable_sort(terms, {}, rank);
  // The stretch of such a cable would be a function of two signals.
  for (int k = 0; k < layout.n_joints; ++k)
    if (plain.stretch[k].state >= 0 && !plain.of_cable[k].empty()) return false;
  return true;
}

}  // namespace

std::optional<PlainTransmission> plain_transmission(const Transmission<double>& transmission,
                                                    const StateLayout& layout) {
  PlainTransmission plain;
  for (int i = 0; i < PlainTransmission::kSpeeds; ++i) {
    plain.speed[i] = plain.position[i] = 0;
    plain.coulomb[i] = plain.viscous[i] = 0, plain.smoothing[i] = 1;
  }
  const ArmParameters<double>& arm = transmission.arm();
  for (int k = 0, n = arm.n; k < n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    if (j.drive != Drive::cable) return std::nullopt;
    plain.travel[k] = j.motor_travel();
    plain.per_rotor_inertia[k] = 1 / j.rotor_inertia;
    plain.rate_per_root[k] = plain.travel[k] / std::sqrt(j.rotor_inertia);
    for (int i = 0; i < n; ++i) plain.path[k][i] = path_per_joint(j, i);
    plain.speed[k] = *layout.motor_rate[k], plain.speed[n + k] = layout.rate[k];
    plain.position[k] = *layout.motor_angle[k], plain.position[n + k] = layout.position[k];
    plain.coulomb[k] = j.motor_coulomb, plain.coulomb[n + k] = j.joint_coulomb;
    plain.viscous[k] = j.motor_viscous, plain.viscous[n + k] = j.joint_viscous;
    plain.smoothing[k] = j.motor_smoothing, plain.smoothing[n + k] = j.joint_smoothing;
  }
  for (int i = 0; i < PlainTransmission::kSpeeds; ++i) plain.per_smoothing[i] = 1 / plain.smoothing[i];
  if (!take_effects(transmission, layout, plain)) return std::nullopt;
  return plain;
}

bool PlainTransmission::has_effects() const {
  return !forces.empty() || std::ranges::any_of(of_cable, [](const auto& terms) { return !terms.empty(); });
}

bool has_kink_near(const PlainTransmission& plain, const Transmission<double>& transmission, const StateLayout& layout,
                   double time, const double* x, const CableForces& at_x, const double* x_2, double deviations,
                   const Eigen::Ref<const Eigen::MatrixXd>& S) {
  const int n = layout.n_joints;
  for (int k = 0; k < n; ++k) {
    if (!plain.has_kinks[k]) continue;
    double variance = 0;
    for (Eigen::Index c = 0; c < S.cols(); ++c) {
      const double stretch = stretch_of(plain, layout, n, k, S.col(c).data(), 1);
      variance += stretch * stretch;
    }
    const double at = stretch_of(plain, layout, n, k, x, 1), rate = stretch_rate_of(plain, layout, n, k, x, 1);
    const double moved = stretch_of(plain, layout, n, k, x_2, 1) - at, reach = deviations * std::sqrt(variance);
    for (const double d : {std::min(moved, 0.0) - reach, std::max(moved, 0.0) + reach}) {
      const double force = cable_force_of(transmission, plain.of_cable[k], k, time, at + d, rate);
      const double most = kStraight * 2 * transmission.arm().joint[k].stiffness * std::abs(d);
      if (!(std::abs(force - at_x.value[k] - at_x.stiff[k] * d) <= most)) return true;
    }
  }
  return false;
}

}  // namespace halyard

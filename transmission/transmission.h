#pragma once
/// From motors to joints: everything between the commanded torque and the force on a joint.
///
///   x  = (r_m / N) q_m - R q,  x' likewise                                     (Eq. 8)
///   g  = cable law(x, x')                                                      (Eq. 6)
///   τ  = scale·command + bias - friction(q_m')      without the cable's pull (r_m/N) g (Eq. 5)
///   F  = Rᵀ g - friction(q') + external                                        (Eqs. 4, 7)
///
/// Effects act at each of these places (effect.h). The plant and the estimators both use this code.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "transmission/cable_law.h"
#include "transmission/coupling.h"
#include "transmission/effect.h"
#include "transmission/friction.h"

namespace halyard {

/// Signals of all joints. Neither the inputs nor what evaluate() computes is initialised; what may be left out is 0.
template <class T>
class ArmSignals {
 public:
  HALYARD_INLINE explicit ArmSignals(int n) {
    for (int k = 0; k < n; ++k)
      joint()[k].motor_torque = joint()[k].motor_error = joint()[k].joint_error = joint()[k].joint_acceleration =
          T(0.0);
  }
  HALYARD_INLINE JointSignals<T>* joint() { return reinterpret_cast<JointSignals<T>*>(storage_); }

 private:
  alignas(JointSignals<T>) std::byte storage_[kMaxJoints * sizeof(JointSignals<T>)];
};

/// Whether evaluate() computes the torques on the motors' rotors. Where the motors' motion is given, the joints' motion
/// does not depend on them.
enum class MotorTorques { wanted, unwanted };

/// Indices of effects, a part of a list.
struct EffectIndices {
  const int* first;
  std::size_t size;
  const int* begin() const { return first; }
  const int* end() const { return first + size; }
};

/// The arm with effects, over scalar T.
template <class T>
class Transmission {
 public:
  Transmission(const ArmParameters<T>& nominal, std::vector<EffectInstance<T>> effects)
      : arm_(nominal), owned_(std::move(effects)) {
    for (const EffectInstance<T>& e : owned_) {
      e.effect->change_parameters(arm_, e.joint, e.p);
      parts_.push_back({n_states_, e.effect->n_states()});
      n_states_ += e.effect->n_states();
      states_stretch_ =
          states_stretch_ || (e.effect->n_states() > 0 && acts_at(e.effect->stages(), EffectStage::stretch));
      states_need_motors_ =
          states_need_motors_ || (e.effect->n_states() > 0 && (e.effect->stages() & kMotorStages) != 0);
    }
    for (int stage = 0; stage < kEffectStages; ++stage) append_by_rank(static_cast<EffectStage>(1u << stage));
    for (int k = 0; k < arm_.n; ++k) travel_[k] = arm_.joint[k].motor_travel();
  }

  /// The parameters with the changes that the effects make to them.
  const ArmParameters<T>& arm() const { return arm_; }
  const std::vector<EffectInstance<T>>& effects() const { return owned_; }
  /// Indices of the effects of this stage, in the order in which they act (Effect::rank()).
  EffectIndices acting(EffectStage stage) const {
    const int at = number_of(stage), first = first_acting_[at];
    return {acting_.data() + first, static_cast<std::size_t>(first_acting_[at + 1] - first)};
  }
  /// Internal states of all effects, in the order of the effects.
  int n_states() const { return n_states_; }

  /// The inputs are the internal states z [n_states] and s.command, s.motor_angle, s.motor_rate, s.joint_position,
  /// s.joint_rate and s.external_force. Computes z_dot [n_states] and all other signals of s except the sensor errors,
  /// which sensor_errors() sets. s: [n]. If motors are unwanted, s.motor_torque may be left out. known: see
  /// joint_count().
  template <int known = 0>
  HALYARD_INLINE void evaluate(double time, const CommandHistory* history, const T* z, JointSignals<T>* s, T* z_dot,
                               MotorTorques motors = MotorTorques::wanted) const;

  /// Sets s.motor_error and s.joint_error: sensor reading minus truth.
  template <int known = 0>
  HALYARD_INLINE void sensor_errors(double time, const T* z, JointSignals<T>* s) const {
    for (int i = 0, n = joint_count<known>(arm_); i < n; ++i) {
      s[i].motor_error = arm_.joint[i].motor_encoder_offset;
      s[i].joint_error = arm_.joint[i].joint_encoder_offset;
    }
    apply(EffectStage::sensors, time, nullptr, z, s);
  }

  /// The rates of s.stretch, m/s: s.stretch_rate, and what the states of effects at the stretch stage change. s and
  /// z_dot are those of evaluate(). rate: [n].
  template <int known = 0>
  HALYARD_INLINE void total_stretch_rates(double time, const CommandHistory* history, const T* z, const T* z_dot,
                                          const JointSignals<T>* s, T* rate) const;

  /// Runs only the command stage: sets s.motor_torque from s.command, without friction.
  template <int known = 0>
  HALYARD_INLINE void commanded_torque(double time, const CommandHistory* history, const T* z,
                                       JointSignals<T>* s) const {
    for (int i = 0, n = joint_count<known>(arm_); i < n; ++i)
      s[i].motor_torque = arm_.joint[i].torque_scale * s[i].command + arm_.joint[i].torque_bias;
    apply(EffectStage::command, time, history, z, s);
  }

 private:
  static constexpr unsigned kMotorStages =
      static_cast<unsigned>(EffectStage::command) | static_cast<unsigned>(EffectStage::motor);

  static bool acts_at(unsigned stages, EffectStage stage) { return (stages & static_cast<unsigned>(stage)) != 0; }

  /// 0 for the first stage.
  static int number_of(EffectStage stage) {
    int number = 0;
    for (auto bit = static_cast<unsigned>(stage); bit > 1; bit >>= 1) ++number;
    return number;
  }

  template <int known>
  HALYARD_INLINE void stretch_cables(JointSignals<T>* s) const;
  template <int known>
  HALYARD_INLINE void add_motor_friction(JointSignals<T>* s) const;
  HALYARD_INLINE void apply(EffectStage stage, double time, const CommandHistory* history, const T* z,
                            JointSignals<T>* s) const {
    for (const int i : acting(stage)) {
      const EffectInstance<T>& e = owned_[i];
      e.effect->act(stage, EffectContext<T>{arm_, e.joint, e.p, z + parts_[i].first_state, time, history}, s);
    }
  }
  /// The stages in their order.
  void append_by_rank(EffectStage stage) {
    const auto first = static_cast<std::ptrdiff_t>(acting_.size());
    for (std::size_t i = 0; i < owned_.size(); ++i)
      if (acts_at(owned_[i].effect->stages(), stage)) acting_.push_back(static_cast<int>(i));
    std::stable_sort(acting_.begin() + first, acting_.end(),
                     [&](int a, int b) { return owned_[a].effect->rank(stage) < owned_[b].effect->rank(stage); });
    first_acting_[number_of(stage) + 1] = static_cast<int>(acting_.size());
  }

  /// What an effect says of itself.
  struct Part {
    int first_state, n_states;
  };

  ArmParameters<T> arm_;
  std::vector<EffectInstance<T>> owned_;
  std::vector<Part> parts_;  ///< of each
  std::vector<int> acting_;  ///< acting() of all stages, one after the other
  int first_acting_[kEffectStages + 1] = {};
  T travel_[kMaxJoints];  ///< r_m / N
  int n_states_ = 0;
  bool states_stretch_ = false;      ///< an effect with states acts at the stretch stage
  bool states_need_motors_ = false;  ///< an effect with states acts at the command or motor stage
};

template <class T>
template <int known>
HALYARD_INLINE void Transmission<T>::stretch_cables(JointSignals<T>* s) const {
  const int n = joint_count<known>(arm_);
  T q[kMaxJoints], v[kMaxJoints], path[kMaxJoints], path_rate[kMaxJoints];
  for (int i = 0; i < n; ++i) q[i] = s[i].joint_position, v[i] = s[i].joint_rate;
  cable_path<known>(arm_, q, path);
  cable_path<known>(arm_, v, path_rate);
  for (int i = 0; i < n; ++i) {
    if (arm_.joint[i].drive == Drive::cable) {
      s[i].stretch = travel_[i] * s[i].motor_angle - path[i];
      s[i].stretch_rate = travel_[i] * s[i].motor_rate - path_rate[i];
    } else {
      s[i].stretch = s[i].stretch_rate = T(0.0);
    }
  }
}

template <class T>
template <int known>
HALYARD_INLINE void Transmission<T>::add_motor_friction(JointSignals<T>* s) const {
  for (int i = 0, n = joint_count<known>(arm_); i < n; ++i) {
    const JointParameters<T>& j = arm_.joint[i];
    s[i].motor_friction_drift = T(0.0);
    if (j.drive == Drive::none) {
      s[i].motor_torque = T(0.0);
      continue;
    }
    s[i].motor_torque -= friction(j.motor_coulomb, j.motor_viscous, j.motor_smoothing, s[i].motor_rate);
  }
}

template <class T>
template <int known>
HALYARD_INLINE void Transmission<T>::evaluate(double time, const CommandHistory* history, const T* z,
                                              JointSignals<T>* s, T* z_dot, MotorTorques motors) const {
  const int n = joint_count<known>(arm_);
  const bool with_motors = motors == MotorTorques::wanted || states_need_motors_;
  if (with_motors) commanded_torque<known>(time, history, z, s);
  stretch_cables<known>(s);
  apply(EffectStage::stretch, time, history, z, s);

  for (int i = 0; i < n; ++i)
    s[i].cable_force_motor = s[i].cable_force_joint =
        arm_.joint[i].drive == Drive::cable ? cable_force(arm_.joint[i], s[i].stretch, s[i].stretch_rate) : T(0.0);
  apply(EffectStage::cable_force, time, history, z, s);

  if (with_motors) {
    add_motor_friction<known>(s);
    apply(EffectStage::motor, time, history, z, s);
  }

  T g[kMaxJoints], reaction[kMaxJoints];
  for (int i = 0; i < n; ++i) g[i] = s[i].cable_force_joint;
  joint_reaction<known>(arm_, g, reaction);
  for (int i = 0; i < n; ++i) {
    const JointParameters<T>& j = arm_.joint[i];
    s[i].joint_friction_drift = T(0.0);
    s[i].joint_force = reaction[i] - friction(j.joint_coulomb, j.joint_viscous, j.joint_smoothing, s[i].joint_rate) +
                       s[i].external_force;
  }
  apply(EffectStage::joint, time, history, z, s);

  if (n_states_ == 0) return;
  const EffectInstance<T>* e = owned_.data();
  const Part* part = parts_.data();
  for (int i = 0, m = static_cast<int>(owned_.size()); i < m; ++i) {
    if (part[i].n_states == 0) continue;
    const int first = part[i].first_state;
    e[i].effect->rates(EffectContext<T>{arm_, e[i].joint, e[i].p, z + first, time, history}, s, z_dot + first);
  }
}

template <class T>
template <int known>
HALYARD_INLINE void Transmission<T>::total_stretch_rates(double time, const CommandHistory* history, const T* z,
                                                         const T* z_dot, const JointSignals<T>* s, T* rate) const {
  constexpr double kBetween = 1e-4;  // s: rounding is 1e-12 of a stretch per second
  const int n = joint_count<known>(arm_);
  for (int i = 0; i < n; ++i) rate[i] = s[i].stretch_rate;
  if (!states_stretch_) return;
  // The effects once more, one after another: those that follow change the rate that one adds, too.
  ArmSignals<T> signals[3] = {ArmSignals<T>(n), ArmSignals<T>(n), ArmSignals<T>(n)};
  JointSignals<T>* const now = signals[1].joint();
  for (int i = 0; i < n; ++i) now[i] = s[i];
  stretch_cables<known>(now);
  for (const int k : acting(EffectStage::stretch)) {
    const EffectInstance<T>& e = owned_[k];
    const Part& part = parts_[k];
    for (const int side : {-1, 1, 0}) {
      T moved[kMaxEffectStates];
      for (int i = 0; i < part.n_states; ++i)
        moved[i] = z[part.first_state + i] + T(side * kBetween) * z_dot[part.first_state + i];
      JointSignals<T>* const at = signals[1 + side].joint();
      for (int i = 0; i < n; ++i) at[i] = now[i];
      e.effect->act(EffectStage::stretch, EffectContext<T>{arm_, e.joint, e.p, moved, time, history}, at);
    }
    for (int i = 0; i < n; ++i)
      now[i].stretch_rate += (signals[2].joint()[i].stretch - signals[0].joint()[i].stretch) / T(2 * kBetween);
  }
  for (int i = 0; i < n; ++i) rate[i] = now[i].stretch_rate;
}

/// The arm with its effects over another scalar type, all lanes equal, all derivatives zero.
template <class T>
Transmission<T> lift_transmission(const ArmParameters<double>& nominal, const std::vector<PlacedEffect>& effects) {
  std::vector<EffectInstance<T>> lifted;
  for (const PlacedEffect& effect : effects) {
    EffectInstance<T> e{effect.effect, effect.joint, {}};
    for (int i = 0; i < kMaxEffectParameters; ++i) e.p[i] = effect.p[i];
    lifted.push_back(e);
  }
  return Transmission<T>(lift<T>(nominal), std::move(lifted));
}

}  // namespace halyard

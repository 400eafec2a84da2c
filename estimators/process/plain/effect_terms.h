#pragma once
/// Effects of one signal (transmission/effects/one_signal.h) in a plain transmission: forces at motors and joints, and
/// what becomes of a cable's stretch and force. Evaluated for one signal at a time, by the code of the effect itself:
/// over Dual for slopes, over Lanes for eight values of the signal.

#include "transmission/effects/one_signal.h"
#include "transmission/transmission.h"

namespace halyard {

/// The action of an effect at one stage.
struct EffectTerm {
  std::size_t effect = 0;  ///< index in the transmission
  EffectStage stage = EffectStage::motor;
  int joint = 0;
};

/// A force at a motor or joint.
struct ForceTerm : EffectTerm {
  Signal signal = Signal::motor_rate;
  int drive = 0;        ///< motor k: k, joint k: n + k
  int state = 0;        ///< index of the signal
  bool of_rate = true;  ///< the signal is a rate
};

template <class T>
HALYARD_INLINE void act(const Transmission<T>& transmission, const EffectTerm& term, double time, JointSignals<T>* s) {
  const EffectInstance<T>& e = transmission.effects()[term.effect];
  e.effect->act(term.stage, EffectContext<T>{transmission.arm(), e.joint, e.p, nullptr, time, nullptr}, s);
}

/// The force against the direction of motion, as that of friction, where the signal is `at`.
template <class T>
HALYARD_INLINE T force_of(const Transmission<T>& transmission, const ForceTerm& term, double time, const T& at) {
  ArmSignals<T> signals(0);
  JointSignals<T>& own = signals.joint()[term.joint];
  switch (term.signal) {
    case Signal::motor_angle: own.motor_angle = at; break;
    case Signal::motor_rate: own.motor_rate = at; break;
    case Signal::joint_position: own.joint_position = at; break;
    case Signal::joint_rate: own.joint_rate = at; break;
  }
  own.motor_torque = own.joint_force = own.motor_friction_drift = own.joint_friction_drift = T(0.0);
  act(transmission, term, time, signals.joint());
  return term.stage == EffectStage::motor ? -own.motor_torque : -own.joint_force;
}

/// The force of cable k, with the terms of this cable: first those at its stretch, then those at its force.
template <class T, class Terms>
HALYARD_INLINE T cable_force_of(const Transmission<T>& transmission, const Terms& terms, int k, double time,
                                const T& stretch, const T& rate) {
  ArmSignals<T> signals(0);
  JointSignals<T>& own = signals.joint()[k];
  own.stretch = stretch, own.stretch_rate = rate;
  for (const EffectTerm& term : terms)
    if (term.stage == EffectStage::stretch) act(transmission, term, time, signals.joint());
  own.cable_force_motor = own.cable_force_joint =
      cable_force(transmission.arm().joint[k], own.stretch, own.stretch_rate);
  for (const EffectTerm& term : terms)
    if (term.stage == EffectStage::cable_force) act(transmission, term, time, signals.joint());
  return own.cable_force_joint;
}

}  // namespace halyard

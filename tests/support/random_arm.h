#pragma once
/// Arms whose numbers are all of the order of one, so that finite differences of their equations are accurate.

#include <random>
#include <vector>

#include "transmission/transmission.h"

namespace halyard {

/// Three cable joints of one law, revolute, revolute, prismatic, with couplings both ways.
inline ArmParameters<double> random_arm(unsigned seed, CableLaw law) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto between = [&](double a, double b) { return a + (b - a) * unit(random); };
  ArmParameters<double> arm;
  arm.n = 3;
  arm.payload_point[0] = between(-0.3, 0.3);
  arm.payload_point[2] = between(0.2, 0.5);
  for (int k = 0; k < 3; ++k) {
    JointParameters<double>& j = arm.joint[k];
    j.type = k == 2 ? JointType::prismatic : JointType::revolute;
    j.law = law;
    j.mass = between(0.5, 2);
    for (int i = 0; i < 3; ++i) {
      j.com[i] = between(-0.3, 0.3);
      j.inertia[i] = between(0.3, 0.5);
      j.inertia[3 + i] = between(-0.1, 0.1);
    }
    j.rotor_inertia = between(0.1, 0.3);
    j.motor_coulomb = between(0.2, 0.4);
    j.motor_viscous = between(0.05, 0.1);
    j.gear_ratio = between(2, 4);
    j.capstan_radius = between(0.3, 0.5);
    j.torque_scale = between(0.9, 1.1);
    j.torque_bias = between(-0.1, 0.1);
    j.pulley_radius = between(0.5, 1);
    for (int i = 0; i < 3; ++i) j.coupling[i] = i == k ? 1 : between(-0.2, 0.2);
    j.stiffness = between(40, 60);
    j.damping = between(1, 3);
    j.tension = between(15, 25);
    j.joint_coulomb = between(0.2, 0.4);
    j.joint_viscous = between(0.05, 0.1);
    j.joint_smoothing = between(0.3, 0.6);
    j.motor_encoder_offset = between(-0.1, 0.1);
    j.joint_encoder_offset = between(-0.1, 0.1);
  }
  return arm;
}

/// Out of line: inlined where the arm is built, GCC 12 warns of arrays beyond arm.n that nothing reads.
template <class T>
__attribute__((noinline)) void evaluate_all(const Transmission<T>& transmission, double time,
                                            const CommandHistory* history, const T* z, JointSignals<T>* s, T* z_dot) {
  transmission.evaluate(time, history, z, s, z_dot);
  transmission.sensor_errors(time, z, s);
}

/// Everything that evaluate() and sensor_errors() read, in one vector: command, motor angle and rate, joint position
/// and rate, external force of each joint; the states; the parameters of the one effect. And everything they write.
template <class T>
struct EvaluatedArm {
  ArmParameters<double> nominal;
  PlacedEffect effect;  ///< none if effect.effect is null

  int n_states() const { return effect.effect ? effect.effect->n_states() : 0; }
  int n_inputs() const { return 6 * nominal.n + n_states() + (effect.effect ? kMaxEffectParameters : 0); }

  std::vector<T> operator()(const std::vector<T>& u, double time = 0, const CommandHistory* history = nullptr) const {
    const int n = nominal.n, m = n_states();
    std::vector<EffectInstance<T>> effects;
    if (effect.effect) {
      effects.push_back({effect.effect, effect.joint, {}});
      for (int i = 0; i < kMaxEffectParameters; ++i) effects[0].p[i] = u[6 * n + m + i];
    }
    const Transmission<T> transmission(lift<T>(nominal), effects);
    JointSignals<T> s[kMaxJoints];
    for (int k = 0; k < n; ++k) {
      s[k].command = u[6 * k];
      s[k].motor_angle = u[6 * k + 1];
      s[k].motor_rate = u[6 * k + 2];
      s[k].joint_position = u[6 * k + 3];
      s[k].joint_rate = u[6 * k + 4];
      s[k].external_force = u[6 * k + 5];
    }
    T z_dot[kMaxEffectStates];
    evaluate_all(transmission, time, history, u.data() + 6 * n, s, z_dot);
    std::vector<T> out(z_dot, z_dot + m);
    for (int k = 0; k < n; ++k)
      for (const T& x : {s[k].motor_torque, s[k].stretch, s[k].stretch_rate, s[k].cable_force_motor,
                         s[k].cable_force_joint, s[k].joint_force, s[k].motor_error, s[k].joint_error})
        out.push_back(x);
    return out;
  }
};

/// Inputs around rest: stretches within ±0.4 m, where a linear cable of random_arm() may well be slack.
inline std::vector<double> random_inputs(const EvaluatedArm<double>& arm, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<double> u;
  for (int i = 0; i < 6 * arm.nominal.n; ++i) u.push_back((i % 6 == 1 || i % 6 == 3 ? 0.3 : 1.0) * unit(random));
  for (int i = 0; i < arm.n_states(); ++i) u.push_back(0.03 * unit(random));
  for (int i = 0; arm.effect.effect && i < kMaxEffectParameters; ++i) u.push_back(arm.effect.p[i]);
  return u;
}

}  // namespace halyard

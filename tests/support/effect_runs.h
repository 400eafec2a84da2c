#pragma once
/// For tests of single effects: a random arm's transmission evaluated at a motion.

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/limits.h"
#include "tests/support/random_arm.h"

namespace halyard {

inline constexpr CableLaw kLaws[] = {CableLaw::paper, CableLaw::exponential, CableLaw::linear};

inline PlacedEffect placed(const std::string& name, const ArmParameters<double>& arm, EffectPlace joint,
                           const std::vector<double>& p) {
  PlacedEffect e = place_effect(*find_effect(name), arm, joint);
  for (std::size_t i = 0; i < p.size(); ++i) e.p[i] = p[i];
  return e;
}

/// Signals of an arm at a motion.
struct Motion {
  double command[3] = {}, motor_angle[3] = {}, motor_rate[3] = {}, joint_position[3] = {}, joint_rate[3] = {};
};
struct Evaluated {
  JointSignals<double> s[kMaxJoints];
  double z_dot[kMaxEffectStates] = {};
};
inline Evaluated evaluate(const Transmission<double>& transmission, const Motion& m, const double* z = nullptr,
                          double time = 0, const CommandHistory* history = nullptr) {
  Evaluated e;
  for (int k = 0; k < transmission.arm().n; ++k) {
    e.s[k].command = m.command[k];
    e.s[k].motor_angle = m.motor_angle[k];
    e.s[k].motor_rate = m.motor_rate[k];
    e.s[k].joint_position = m.joint_position[k];
    e.s[k].joint_rate = m.joint_rate[k];
  }
  evaluate_all(transmission, time, history, z, e.s, e.z_dot);
  return e;
}

/// The motion that stretches joint k's cable by x at the rate x', all joints at rest at zero.
inline Motion stretched(const ArmParameters<double>& arm, int k, double x, double x_dot) {
  Motion m;
  m.motor_angle[k] = x / arm.joint[k].motor_travel();
  m.motor_rate[k] = x_dot / arm.joint[k].motor_travel();
  return m;
}

inline Motion random_motion(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Motion m;
  for (int k = 0; k < 3; ++k) {
    m.motor_angle[k] = 0.3 * unit(random), m.motor_rate[k] = unit(random);
    m.joint_position[k] = 0.3 * unit(random), m.joint_rate[k] = unit(random);
  }
  return m;
}

/// Parameters of an effect, anywhere in its bounds or at one of them.
inline std::vector<double> within_bounds(const std::vector<EffectParameter>& parameters, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(-0.5, 1.5);
  std::vector<double> p;
  for (const EffectParameter& e : parameters)
    p.push_back(e.lower + std::clamp(share(random), 0.0, 1.0) * (e.upper - e.lower));
  return p;
}

}  // namespace halyard

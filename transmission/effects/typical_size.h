#pragma once
/// Typical sizes of quantities that a model may set to zero, derived from the arm's other parameters.

#include <algorithm>
#include <cmath>

#include "transmission/arm_parameters.h"

namespace halyard {

/// Plausible friction at the joint, N m | N: the largest of the joint's own Coulomb friction, the motor's Coulomb
/// friction referred to the joint, and 2 % of the torque | force that the link's weight can exert.
inline double typical_joint_friction(const JointParameters<double>& j) {
  const double arm = j.type == JointType::revolute ? std::hypot(j.com[0], j.com[1], j.com[2]) : 1;
  const double weight = 0.02 * 9.81 * j.mass * arm;
  const double motor = j.drive == Drive::none ? 0 : j.motor_coulomb * j.pulley_radius / j.motor_travel();
  return std::max({j.joint_coulomb, motor, weight, 1e-6});
}

/// Plausible friction at the motor shaft, N m.
inline double typical_motor_friction(const JointParameters<double>& j) {
  return std::max(j.motor_coulomb, typical_joint_friction(j) * j.motor_travel() / j.pulley_radius);
}

/// Typical stretch of the cable in use, m: from its rest tension or from its joint's friction, whichever is larger.
inline double typical_stretch(const JointParameters<double>& j) {
  const double friction = 0.5 * typical_joint_friction(j) / j.pulley_radius;
  return std::max(std::max(j.tension, friction) / j.stiffness, 1e-9);
}

/// m: 3 % of the capstan's radius, at most ten typical stretches. The latter is for gears, whose radius is 1.
inline double typical_half_gap(const JointParameters<double>& j) {
  return std::min(0.03 * j.capstan_radius, 10 * typical_stretch(j));
}

}  // namespace halyard

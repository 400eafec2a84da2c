#pragma once
/// Sizes that an arm's own numbers suggest for a quantity that its model may put at nothing.

#include <algorithm>
#include <cmath>

#include "transmission/arm_parameters.h"

namespace halyard {

/// A friction at the joint that could be there, N m | N: the joint's own, the motor's seen from the joint, or a small
/// part of what the link's weight can ask for, whichever is largest.
inline double typical_joint_friction(const JointParameters<double>& j) {
  const double arm = j.type == JointType::revolute ? std::hypot(j.com[0], j.com[1], j.com[2]) : 1;
  const double weight = 0.02 * 9.81 * j.mass * arm;
  const double motor = j.drive == Drive::none ? 0 : j.motor_coulomb * j.pulley_radius / j.motor_travel();
  return std::max({j.joint_coulomb, motor, weight, 1e-6});
}

/// The same at the motor shaft, N m.
inline double typical_motor_friction(const JointParameters<double>& j) {
  return std::max(j.motor_coulomb, typical_joint_friction(j) * j.motor_travel() / j.pulley_radius);
}

/// A stretch that the cable sees in use, m: by its rest tension, or by the friction of its joint.
inline double typical_stretch(const JointParameters<double>& j) {
  const double friction = 0.5 * typical_joint_friction(j) / j.pulley_radius;
  return std::max(std::max(j.tension, friction) / j.stiffness, 1e-9);
}

}  // namespace halyard

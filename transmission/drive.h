#pragma once
/// The drives of the joints: how motors and joints move together, and which torques and forces accelerate them. The
/// plant, the process model and the diagnosis' prediction all use these functions.
///
///   cable   J q_m'' = τ - (r_m/N) g       the motor moves on its own                (Eq. 5)
///   rigid   q_m = R_k q N/r_m             the motor follows the joints, which feel R_kᵀ τ N/r_m and carry the rotor
///                                         (add_rotor_mass() of coupling.h)
///   none    there is no motor
///
///   τ   torque on the rotor without the cable's pull      N m
///   g   force of the cable on the capstan                 N
///
/// To evaluate an arm at one instant, call set_motion(), Transmission::evaluate(), drive_forces().

#include "transmission/transmission.h"

namespace halyard {

/// Sets motor and joint motion of all joints from q and v [n]. Motors of cable drives are not changed: their motion is
/// a separate state.
template <int known = 0, class T>
HALYARD_INLINE void set_motion(const ArmParameters<T>& arm, const T* q, const T* v, JointSignals<T>* s) {
  for (int k = 0, n = joint_count<known>(arm); k < n; ++k) {
    s[k].joint_position = q[k];
    s[k].joint_rate = v[k];
    if (arm.joint[k].drive == Drive::rigid) {
      s[k].motor_angle = rigid_motor<known>(arm, k, q);
      s[k].motor_rate = rigid_motor<known>(arm, k, v);
    } else if (arm.joint[k].drive == Drive::none) {
      s[k].motor_angle = s[k].motor_rate = T(0.0);
    }
  }
}

/// Torque that accelerates the rotor, N m: `torque` minus the torque of the cable's pull.
template <class T>
HALYARD_INLINE T rotor_torque(const JointParameters<T>& joint, const T& torque, const T& pull) {
  return torque - joint.motor_travel() * pull;
}

/// From torques τ and cable pulls g [n]: adds the forces of rigid drives to joint_force [n], and sets the
/// motor_acceleration of cable drives, rad/s². Other entries are not changed.
template <int known = 0, class T>
HALYARD_INLINE void drive_forces(const ArmParameters<T>& arm, const T* torque, const T* pull, T* joint_force,
                                 T* motor_acceleration) {
  for (int k = 0, n = joint_count<known>(arm); k < n; ++k) {
    const JointParameters<T>& joint = arm.joint[k];
    if (joint.drive == Drive::rigid)
      add_cable_reaction<known>(arm, k, T(torque[k] / joint.motor_travel()), joint_force);
    if (joint.drive == Drive::cable)
      motor_acceleration[k] = rotor_torque(joint, torque[k], pull[k]) / joint.rotor_inertia;
  }
}

}  // namespace halyard

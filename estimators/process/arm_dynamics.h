#pragma once
/// The process model's differential equation, for any scalar type: motors, transmission with its
/// effects, and the rigid chain.
///
///   J q_m'' = τ - (r_m / N) g                        (Eq. 5; τ with the motor's friction)
///   M(q) q'' + h(q, q') = F                          (Eq. 4; F of transmission.h)
///
/// The state has first the positions, joint by joint: [q_m, q] of a cable-driven joint and [q] of one that is driven
/// rigidly or not at all. Their rates follow in the same order, then the internal states of the effects. The drives are
/// those of transmission/drive.h: M includes the rotors of rigid drives.

#include <optional>

#include "model/rigid_chain.h"
#include "transmission/drive.h"

namespace halyard {

inline constexpr int kMaxStates = 64;

/// Indices of each joint's quantities in the state.
struct StateLayout {
  int n_joints = 0;
  int n_effect_states = 0;
  std::optional<int> motor_angle[kMaxJoints], motor_rate[kMaxJoints];  ///< only of motors that drive cables
  int position[kMaxJoints] = {}, rate[kMaxJoints] = {};                ///< of the first n_joints
  int positions = 0;      ///< of motors and joints; i has its rate at positions + i
  int effect_states = 0;  ///< index of the first internal state
  int size = 0;
};

template <class T>
StateLayout state_layout(const Transmission<T>& transmission) {
  StateLayout l;
  l.n_joints = transmission.arm().n;
  l.n_effect_states = transmission.n_states();
  for (int k = 0; k < l.n_joints; ++k) {
    if (transmission.arm().joint[k].drive == Drive::cable) l.motor_angle[k] = l.positions++;
    l.position[k] = l.positions++;
  }
  for (int k = 0; k < l.n_joints; ++k) {
    if (l.motor_angle[k]) l.motor_rate[k] = l.positions + *l.motor_angle[k];
    l.rate[k] = l.positions + l.position[k];
  }
  l.effect_states = 2 * l.positions;
  l.size = l.effect_states + l.n_effect_states;
  return l;
}

/// The signals of a state: motor and joint motion of every joint.
template <int known = 0, class T>
HALYARD_INLINE void unpack_state(const ArmParameters<T>& arm, const StateLayout& l, const T* x, JointSignals<T>* s) {
  T q[kMaxJoints], v[kMaxJoints];
  for (int k = 0, n = joint_count<known>(arm); k < n; ++k) {
    q[k] = x[l.position[k]];
    v[k] = x[l.rate[k]];
    if (arm.joint[k].drive != Drive::cable) continue;
    s[k].motor_angle = x[*l.motor_angle[k]];
    s[k].motor_rate = x[*l.motor_rate[k]];
  }
  set_motion<known>(arm, q, v, s);
}

/// What the transmission does at state x: F on the joints, the accelerations of the motors, and the rates of the
/// effects' states. command, external: [n], held over the step.
template <int known = 0, class T>
HALYARD_INLINE void set_forces(const Transmission<T>& transmission, const StateLayout& l, double time,
                               const CommandHistory* history, const T* command, const T* external, const T* x, T* force,
                               T* motor_acceleration, T* z_dot) {
  const ArmParameters<T>& arm = transmission.arm();
  const int n = joint_count<known>(arm);
  ArmSignals<T> signals(n);
  JointSignals<T>* s = signals.joint();
  unpack_state<known>(arm, l, x, s);
  for (int k = 0; k < n; ++k) s[k].command = command[k], s[k].external_force = external[k];
  transmission.template evaluate<known>(time, history, x + l.effect_states, s, z_dot);
  T torque[kMaxJoints], pull[kMaxJoints];
  for (int k = 0; k < n; ++k) {
    force[k] = s[k].joint_force;
    torque[k] = s[k].motor_torque;
    pull[k] = s[k].cable_force_motor;
  }
  drive_forces<known>(arm, torque, pull, force, motor_acceleration);
}

/// x' at state x. command, external: [n], held over the step.
template <int known = 0, class T>
HALYARD_INLINE void state_derivative(const Transmission<T>& transmission, const StateLayout& l, double time,
                                     const CommandHistory* history, const T* command, const T* external, const T* x,
                                     T* x_dot) {
  const ArmParameters<T>& arm = transmission.arm();
  const int n = joint_count<known>(arm);
  ArmSignals<T> signals(n);
  JointSignals<T>* s = signals.joint();
  unpack_state<known>(arm, l, x, s);
  T q[kMaxJoints], v[kMaxJoints], zero[kMaxJoints], bias[kMaxJoints];
  for (int k = 0; k < n; ++k) {
    s[k].command = command[k];
    s[k].external_force = external[k];
    q[k] = s[k].joint_position, v[k] = s[k].joint_rate, zero[k] = T(0.0);
  }
  transmission.template evaluate<known>(time, history, x + l.effect_states, s, x_dot + l.effect_states);

  const ChainPose<T> pose = chain_pose<known>(arm, q);
  inverse_dynamics<known>(arm, pose, v, zero, bias);
  T M[kMaxJoints][kMaxJoints], a[kMaxJoints], torque[kMaxJoints], pull[kMaxJoints], motor_acceleration[kMaxJoints];
  mass_matrix<known>(arm, pose, M);
  add_rotor_mass<known>(arm, M);
  ldl_factor<T, kMaxJoints>(n, M);
  for (int k = 0; k < n; ++k) {
    a[k] = s[k].joint_force - bias[k];
    torque[k] = s[k].motor_torque;
    pull[k] = s[k].cable_force_motor;
  }
  drive_forces<known>(arm, torque, pull, a, motor_acceleration);
  ldl_solve<T, kMaxJoints>(n, M, a);

  for (int k = 0; k < n; ++k) {
    x_dot[l.position[k]] = v[k];
    x_dot[l.rate[k]] = a[k];
    if (arm.joint[k].drive != Drive::cable) continue;
    x_dot[*l.motor_angle[k]] = s[k].motor_rate;
    x_dot[*l.motor_rate[k]] = motor_acceleration[k];
  }
}

/// One step of the classical fourth-order Runge-Kutta method, in place.
template <int known = 0, class T>
HALYARD_INLINE void runge_kutta_4(const Transmission<T>& transmission, const StateLayout& l, double time, double h,
                                  const CommandHistory* history, const T* command, const T* external, T* x) {
  T k[kMaxStates], sum[kMaxStates], at[kMaxStates];
  for (int i = 0; i < l.size; ++i) at[i] = x[i], sum[i] = T(0.0);
  for (int stage = 0; stage < 4; ++stage) {  // a loop, so that there is one copy of the derivative
    const double into_step = stage == 0 ? 0 : stage < 3 ? 0.5 * h : h;
    state_derivative<known>(transmission, l, time + into_step, history, command, external, at, k);
    const double weight = stage == 0 || stage == 3 ? 1 : 2, next = stage < 2 ? 0.5 * h : h;
    for (int i = 0; i < l.size; ++i) {
      sum[i] += T(weight) * k[i];
      at[i] = x[i] + T(next) * k[i];
    }
  }
  for (int i = 0; i < l.size; ++i) x[i] += T(h / 6) * sum[i];
}

}  // namespace halyard

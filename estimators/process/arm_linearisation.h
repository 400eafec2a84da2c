#pragma once
/// x' of arm_dynamics.h and its Jacobian A, by the structure of the equations:
///
///   M(q) a + h(q, q') = F(x, z)      ∂a = M⁻¹ (∂F - ∂(M a + h) at constant a)
///
///   a   accelerations of the joints     [n]      rad/s² | m/s²
///   F   forces on the joints            [n]      N m | N
///
/// Dual numbers differentiate the transmission in all directions of the state. Without effects in the way, they only
/// differentiate each cable's force in its stretch and stretch rate, and each friction in its speed; the rest is linear.
/// Slopes differentiate the inverse dynamics in the directions of q and q'. Neither passes through the mass matrix, its
/// factors or its columns.

#include "estimators/process/arm_dynamics.h"
#include "estimators/process/slopes.h"

namespace halyard {

/// F, and its slopes in all directions of the state.
struct JointForces {
  double value[kMaxJoints];
  double slope[kMaxJoints][kMaxStates];
};

/// F, and all rows of x_dot and A but those of the joints' rates.
template <int known>
HALYARD_INLINE void linearise_transmission(const Transmission<Dual>& transmission, const StateLayout& l, double time,
                                           const CommandHistory* history, const Dual* command, const Dual* external,
                                           const double* x, double* x_dot, double* A, JointForces& forces) {
  const ArmParameters<Dual>& arm = transmission.arm();
  const int n = joint_count<known>(arm);
  for (int first = 0; first < l.size; first += kDualWidth) {
    const int count = l.size - first < kDualWidth ? l.size - first : kDualWidth;
    Dual at[kMaxStates], z_dot[kMaxStates];
    for (int i = 0; i < l.size; ++i) at[i] = Dual(x[i]);
    for (int i = 0; i < count; ++i) at[first + i].d.set(i, 1);
    ArmSignals<Dual> signals(n);
    JointSignals<Dual>* s = signals.joint();
    unpack_state<known>(arm, l, at, s);
    for (int k = 0; k < n; ++k) s[k].command = command[k], s[k].external_force = external[k];
    transmission.template evaluate<known>(time, history, at + l.effect_states, s, z_dot);
    Dual force[kMaxJoints], torque[kMaxJoints], pull[kMaxJoints], motor_acceleration[kMaxJoints];
    for (int k = 0; k < n; ++k) {
      force[k] = s[k].joint_force;
      torque[k] = s[k].motor_torque;
      pull[k] = s[k].cable_force_motor;
    }
    drive_forces<known>(arm, torque, pull, force, motor_acceleration);
    const auto put = [&](int row, const Dual& rate) __attribute__((always_inline)) {
      x_dot[row] = rate.a;
      for (int i = 0; i < count; ++i) A[row + (first + i) * l.size] = rate.d[i];
    };
    for (int k = 0; k < n; ++k) {
      forces.value[k] = force[k].a;
      for (int i = 0; i < count; ++i) forces.slope[k][first + i] = force[k].d[i];
      put(l.position[k], at[l.rate[k]]);
      if (arm.joint[k].drive != Drive::cable) continue;
      put(*l.motor_angle[k], at[*l.motor_rate[k]]);
      put(*l.motor_rate[k], motor_acceleration[k]);
    }
    for (int i = 0; i < l.n_effect_states; ++i) put(l.effect_states + i, z_dot[i]);
  }
}

/// Whether cables drive all joints and no effect acts between the commands and the joints.
template <int known>
HALYARD_INLINE bool is_plain(const Transmission<Dual>& transmission) {
  constexpr unsigned kSensors = static_cast<unsigned>(EffectStage::sensors);
  for (int k = 0, n = joint_count<known>(transmission.arm()); k < n; ++k)
    if (transmission.arm().joint[k].drive != Drive::cable) return false;
  for (const EffectInstance<Dual>& e : transmission.effects())
    if ((e.effect->stages() & ~kSensors) != 0 || e.effect->n_states() > 0) return false;
  return true;
}

/// The same as linearise_transmission(), for a plain transmission.
template <int known>
HALYARD_INLINE void linearise_plain_transmission(const ArmParameters<Dual>& dual, const ArmParameters<double>& arm,
                                                 const StateLayout& l, const Dual* command, const Dual* external,
                                                 const double* x, double* x_dot, double* A, JointForces& forces) {
  const int n = joint_count<known>(arm), size = l.size;
  for (int i = 0; i < size * size; ++i) A[i] = 0;
  for (int k = 0; k < n; ++k) {
    const JointParameters<Dual>& j = dual.joint[k];
    const Dual held = friction(j.joint_coulomb, j.joint_viscous, j.joint_smoothing, Dual::seed(x[l.rate[k]], 0));
    forces.value[k] = external[k].a - held.a;
    for (int i = 0; i < size; ++i) forces.slope[k][i] = 0;
    forces.slope[k][l.rate[k]] = -held.d[0];
  }
  for (int k = 0; k < n; ++k) {
    const JointParameters<Dual>& j = dual.joint[k];
    const int angle = *l.motor_angle[k], rate = *l.motor_rate[k];
    const double travel = arm.joint[k].motor_travel(), per_inertia = 1 / arm.joint[k].rotor_inertia;
    double path[kMaxJoints], stretch = travel * x[angle], stretch_rate = travel * x[rate];
    for (int i = 0; i < n; ++i) {
      path[i] = path_per_joint(arm.joint[k], i);
      stretch -= path[i] * x[l.position[i]];
      stretch_rate -= path[i] * x[l.rate[i]];
    }
    const Dual g = cable_force(j, Dual::seed(stretch, 0), Dual::seed(stretch_rate, 1));
    const Dual held = friction(j.motor_coulomb, j.motor_viscous, j.motor_smoothing, Dual::seed(x[rate], 0));
    const double torque = arm.joint[k].torque_scale * command[k].a + arm.joint[k].torque_bias - held.a;
    x_dot[angle] = x[rate];
    x_dot[rate] = per_inertia * (torque - travel * g.a);
    x_dot[l.position[k]] = x[l.rate[k]];
    A[angle + rate * size] = A[l.position[k] + l.rate[k] * size] = 1;
    const double pull = travel * per_inertia, stiff = g.d[0], damped = g.d[1];
    A[rate + angle * size] = -pull * travel * stiff;
    A[rate + rate * size] = -pull * travel * damped - per_inertia * held.d[0];
    for (int i = 0; i < n; ++i) {
      A[rate + l.position[i] * size] = pull * path[i] * stiff;
      A[rate + l.rate[i] * size] = pull * path[i] * damped;
      forces.value[i] += path[i] * g.a;
      forces.slope[i][angle] = path[i] * travel * stiff;
      forces.slope[i][rate] = path[i] * travel * damped;
      for (int c = 0; c < n; ++c) {
        forces.slope[i][l.position[c]] -= path[i] * path[c] * stiff;
        forces.slope[i][l.rate[c]] -= path[i] * path[c] * damped;
      }
    }
  }
}

/// Subtracts from the slopes those of M(q) a + h(q, q') at constant a.
template <int known>
HALYARD_INLINE void subtract_chain_slopes(const ArmParameters<double>& arm, const StateLayout& l, const double* x,
                                          const double* a, JointForces& forces) {
  const int n = joint_count<known>(arm);
  for (int first = 0; first < 2 * n; first += kLaneWidth) {  // directions: q, then q'
    Slopes q[kMaxJoints], v[kMaxJoints], held[kMaxJoints], force[kMaxJoints];
    for (int k = 0; k < n; ++k) {
      q[k] = x[l.position[k]];
      v[k] = x[l.rate[k]];
      held[k] = a[k];
    }
    const int count = 2 * n - first < kLaneWidth ? 2 * n - first : kLaneWidth;
    for (int i = 0; i < count; ++i) {
      const int direction = first + i;
      (direction < n ? q[direction] : v[direction - n]).d.set(i, 1);
    }
    inverse_dynamics<known>(arm, chain_pose<known>(arm, q), v, held, force);
    for (int i = 0; i < count; ++i) {
      const int direction = first + i;
      const int column = direction < n ? l.position[direction] : l.rate[direction - n];
      for (int k = 0; k < n; ++k) forces.slope[k][column] -= force[k].d[i];
    }
  }
}

/// x_dot [size], A = ∂x'/∂x [size x size] and mobility = M(q)⁻¹ [n x n], column-major. `arm`: the parameters of the
/// transmission. command, external: [n]. known: see joint_count().
template <int known = 0>
HALYARD_INLINE void linearised_derivative(const Transmission<Dual>& transmission, const ArmParameters<double>& arm,
                                          const StateLayout& l, double time, const CommandHistory* history,
                                          const Dual* command, const Dual* external, const double* x, double* x_dot,
                                          double* A, double* mobility) {
  const int n = joint_count<known>(arm);
  JointForces forces;
  if (is_plain<known>(transmission))
    linearise_plain_transmission<known>(transmission.arm(), arm, l, command, external, x, x_dot, A, forces);
  else linearise_transmission<known>(transmission, l, time, history, command, external, x, x_dot, A, forces);
  double q[kMaxJoints], v[kMaxJoints], zero[kMaxJoints], bias[kMaxJoints], a[kMaxJoints];
  for (int k = 0; k < n; ++k) q[k] = x[l.position[k]], v[k] = x[l.rate[k]], zero[k] = 0;
  const ChainPose<double> pose = chain_pose<known>(arm, q);
  inverse_dynamics<known>(arm, pose, v, zero, bias);
  double M[kMaxJoints][kMaxJoints];
  mass_matrix<known>(arm, pose, M);
  add_rotor_mass<known>(arm, M);
  ldl_factor<double, kMaxJoints>(n, M);
  for (int k = 0; k < n; ++k) a[k] = forces.value[k] - bias[k];
  ldl_solve<double, kMaxJoints>(n, M, a);
  subtract_chain_slopes<known>(arm, l, x, a, forces);
  for (int c = 0; c < l.size; ++c) {
    double column[kMaxJoints];
    for (int k = 0; k < n; ++k) column[k] = forces.slope[k][c];
    ldl_solve<double, kMaxJoints>(n, M, column);
    for (int k = 0; k < n; ++k) A[l.rate[k] + c * l.size] = column[k];
  }
  for (int k = 0; k < n; ++k) x_dot[l.rate[k]] = a[k];
  for (int c = 0; c < n; ++c) {
    for (int k = 0; k < n; ++k) mobility[k + c * n] = k == c;
    ldl_solve<double, kMaxJoints>(n, M, mobility + c * n);
  }
}

}  // namespace halyard

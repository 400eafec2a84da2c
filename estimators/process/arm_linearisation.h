#pragma once
/// x' of arm_dynamics.h and its Jacobian A, by the structure of the equations:
///
///   M(q) a + h(q, q') = F(x, z)      ∂a = M⁻¹ (∂F - ∂(M a + h) at constant a)
///
///   a   accelerations of the joints     [n]      rad/s² | m/s²
///   F   forces on the joints            [n]      N m | N
///
/// M and the slopes may be those of a state shortly before, M_0 and its a_0. Then a = a_0 + M_0⁻¹ (F - (M a_0 + h)),
/// whose error is the change of M since then times that of a.
///
/// Dual numbers differentiate the transmission in all directions of the state, if it is not plain. Slopes (slopes.h)
/// differentiates the inverse dynamics in the directions of q and q'. The mass matrix is not differentiated.

#include "estimators/process/plain/plain_transmission.h"
#include "estimators/process/slopes.h"

namespace halyard {

/// F, and its slopes in all directions of the state.
struct JointForces {
  double value[kMaxJoints] = {};
  double slope[kMaxJoints][kMaxStates];
};

/// What is found of the rigid chain.
struct ChainPoint {
  double mass[kMaxJoints][kMaxJoints];       ///< M
  double mobility[kMaxJoints * kMaxJoints];  ///< M⁻¹ [n x n], column-major
  double slope[kMaxJoints][2 * kMaxJoints];  ///< of M a + h at constant a, in q and then in q'
  double acceleration[kMaxJoints];           ///< a
  double curvature[kMaxJoints];              ///< of M a + h: its mean, set by chain_curvature() of arm_curvature.h
};

/// Slopes of friction and cables in A.
struct DriveSlopes {
  double in_rate[2 * kMaxJoints], in_position[2 * kMaxJoints];  ///< of friction
  double stiff[kMaxJoints], damped[kMaxJoints];                 ///< of the cables
  double root_of_stiff[kMaxJoints];                             ///< √|stiff|
};

HALYARD_INLINE void set_slopes(const Frictions& friction, const CableForces& cable, int n, DriveSlopes& slopes) {
  for (int i = 0; i < 2 * n; ++i)
    slopes.in_rate[i] = friction.slope[i], slopes.in_position[i] = friction.in_position[i];
  for (int k = 0; k < n; ++k) {
    slopes.stiff[k] = cable.stiff[k], slopes.damped[k] = cable.damped[k];
    slopes.root_of_stiff[k] = __builtin_sqrt(abs(cable.stiff[k]));
  }
}

/// What a linearisation finds besides x' and A.
struct LinearisedPoint {
  ChainPoint chain;
  double force[kMaxJoints];  ///< F
  Frictions friction;        ///< of a plain transmission, as the next
  CableForces cable;
  DriveSlopes of_A;        ///< those above, or of a state shortly before, if A is (arm_second_stage.h)
  double excess_rate = 0;  ///< how far friction and cables are from these (arm_second_stage.h), 1/s
};

/// A step whose impulses are followed (arm_impulses.h).
struct ImpulseStep {
  double time_s;                 ///< at the start
  const LinearisedPoint& start;  ///< at x
  const double *A, *x, *x_2;     ///< ∂f/∂x at x, the state at the start and at the end
  double dt_s;
  int substeps;  ///< even
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
    Dual at[kMaxStates], z_dot[kMaxStates], force[kMaxJoints], motor_acceleration[kMaxJoints];
    for (int i = 0; i < l.size; ++i) at[i] = Dual(x[i]);
    for (int i = 0; i < count; ++i) at[first + i].d.set(i, 1);
    set_forces<known>(transmission, l, time, history, command, external, at, force, motor_acceleration, z_dot);
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

/// The arm's equations, and what is held over a step.
struct LinearisedArm {
  const Transmission<Dual>& transmission;
  const Transmission<Lanes>& lanes;  ///< the same, as are the next
  const PlainTransmission* plain;    ///< null if it is not plain
  const ArmParameters<double>& arm;
  const StateLayout& layout;
};
struct HeldInputs {
  const CommandHistory* history;
  const Dual *command, *external;  ///< [n]
};

/// F of a plain transmission, the rows of x_dot but those of the joints' rates, and what friction and cables are at x.
template <int known>
HALYARD_INLINE void set_plain_forces(const LinearisedArm& model, double time, const HeldInputs& in, const double* x,
                                     Frictions& friction, CableForces& cable, double* x_dot, double* force) {
  const PlainTransmission& t = *model.plain;
  const ArmParameters<double>& arm = model.arm;
  const StateLayout& l = model.layout;
  const int n = joint_count<known>(arm);
  set_frictions<known>(t, model.transmission, time, x, friction);
  set_cable_forces<known>(t, model.transmission, arm, l, time, x, cable);
  for (int i = l.effect_states; i < l.size; ++i) x_dot[i] = 0;
  for (int k = 0; k < n; ++k) {
    force[k] = in.external[k].a - friction.value[n + k];
    if (const PlainTransmission::Constant& added = t.force[k]; added.state >= 0)
      force[k] += added.factor * x[added.state];
  }
  for (int k = 0; k < n; ++k) {
    const double torque = arm.joint[k].torque_scale * in.command[k].a + arm.joint[k].torque_bias - friction.value[k];
    x_dot[*l.motor_angle[k]] = x[*l.motor_rate[k]];
    x_dot[*l.motor_rate[k]] = t.per_rotor_inertia[k] * (torque - t.travel[k] * cable.value[k]);
    x_dot[l.position[k]] = x[l.rate[k]];
    for (int i = 0; i < n; ++i) force[i] += t.path[k][i] * cable.value[k];
  }
}

/// The slopes of F, and the rows of A but those of the joints' rates.
template <int known>
HALYARD_INLINE void set_plain_slopes(const PlainTransmission& t, const ArmParameters<double>& arm, const StateLayout& l,
                                     const Frictions& friction, const CableForces& cable, double* A,
                                     JointForces& forces) {
  const int n = joint_count<known>(arm), size = l.size;
  for (int i = 0; i < size * size; ++i) A[i] = 0;
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < size; ++i) forces.slope[k][i] = 0;
    forces.slope[k][l.rate[k]] = -friction.slope[n + k];
    forces.slope[k][l.position[k]] = -friction.in_position[n + k];
    if (const PlainTransmission::Constant& added = t.force[k]; added.state >= 0)
      forces.slope[k][added.state] = added.factor;
  }
  for (int k = 0; k < n; ++k) {
    const int angle = *l.motor_angle[k], rate = *l.motor_rate[k];
    const double travel = t.travel[k], per_inertia = t.per_rotor_inertia[k];
    A[angle + rate * size] = A[l.position[k] + l.rate[k] * size] = 1;
    A[rate + rate * size] = -per_inertia * friction.slope[k];
    A[rate + angle * size] = -per_inertia * friction.in_position[k];
    const double pull = travel * per_inertia, stiff = cable.stiff[k], damped = cable.damped[k];
    // The slope of the cable's force in a state.
    const auto add = [&](int state, double slope) __attribute__((always_inline)) {
      A[rate + state * size] -= pull * slope;
      for (int i = 0; i < n; ++i) forces.slope[i][state] += t.path[k][i] * slope;
    };
    add(angle, travel * stiff);
    add(rate, travel * damped);
    for (int i = 0; i < n; ++i) {
      add(l.position[i], -t.path[k][i] * stiff);
      add(l.rate[i], -t.path[k][i] * damped);
    }
    if (const PlainTransmission::Constant& added = t.stretch[k]; added.state >= 0)
      add(added.state, added.factor * stiff);
  }
}

/// The slopes of M(q) a + h(q, q') at constant a.
template <int known>
HALYARD_INLINE void set_chain_slopes(const ArmParameters<double>& arm, const StateLayout& l, const double* x,
                                     const double* a, ChainPoint& point) {
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
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < count; ++i) point.slope[k][first + i] = force[k].d[i];
  }
}

/// M and its inverse.
template <int known>
HALYARD_INLINE void set_mobility(const ArmParameters<double>& arm, const ChainPose<double>& pose, ChainPoint& point) {
  const int n = joint_count<known>(arm);
  mass_matrix<known>(arm, pose, point.mass);
  add_rotor_mass<known>(arm, point.mass);
  double factor[kMaxJoints][kMaxJoints];
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) factor[r][c] = point.mass[r][c];
  ldl_factor<double, kMaxJoints>(n, factor);
  for (int c = 0; c < n; ++c) {
    for (int k = 0; k < n; ++k) point.mobility[k + c * n] = k == c;
    ldl_solve<double, kMaxJoints>(n, factor, point.mobility + c * n);
  }
}

/// out = M⁻¹ v.
HALYARD_INLINE void mobility_times(const ChainPoint& point, int n, const double* v, double* out) {
  for (int k = 0; k < n; ++k) {
    out[k] = 0;
    for (int i = 0; i < n; ++i) out[k] += point.mobility[k + i * n] * v[i];
  }
}

/// M a + h, with the rotors of rigid drives that M includes (coupling.h). v, a, force: [n].
template <int known, class T>
HALYARD_INLINE void chain_force(const ArmParameters<double>& arm, const ChainPose<T>& pose, const T* v, const T* a,
                                T* force) {
  inverse_dynamics<known>(arm, pose, v, a, force);
  for (int k = 0, n = joint_count<known>(arm); k < n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    if (j.drive != Drive::rigid) continue;
    const double turns = j.pulley_radius / j.motor_travel();
    T torque(0.0);
    for (int i = 0; i < n; ++i) torque += (j.rotor_inertia * turns * turns * j.coupling[i]) * a[i];
    for (int i = 0; i < n; ++i) force[i] += j.coupling[i] * torque;
  }
}

/// a at x under the forces F, into x_dot and `chain`: from M and a that `chain` has.
template <int known>
HALYARD_INLINE void set_accelerations(const ArmParameters<double>& arm, const StateLayout& l,
                                      const ChainPose<double>& pose, const double* x, const double* force,
                                      ChainPoint& chain, double* x_dot) {
  const int n = joint_count<known>(arm);
  double v[kMaxJoints], rest[kMaxJoints], change[kMaxJoints];
  for (int k = 0; k < n; ++k) v[k] = x[l.rate[k]];
  chain_force<known>(arm, pose, v, chain.acceleration, rest);
  for (int k = 0; k < n; ++k) rest[k] = force[k] - rest[k];
  mobility_times(chain, n, rest, change);
  for (int k = 0; k < n; ++k) x_dot[l.rate[k]] = chain.acceleration[k] += change[k];
}

template <int known>
HALYARD_INLINE ChainPose<double> pose_at(const ArmParameters<double>& arm, const StateLayout& l, const double* x) {
  double q[kMaxJoints];
  for (int k = 0, n = joint_count<known>(arm); k < n; ++k) q[k] = x[l.position[k]];
  return chain_pose<known>(arm, q);
}

/// F with its slopes, and all rows of x_dot and A but those of the joints' rates. Of a plain transmission also what
/// friction and cables are.
template <int known>
HALYARD_INLINE void linearise_forces(const LinearisedArm& model, double time, const HeldInputs& in, const double* x,
                                     Frictions& friction, CableForces& cable, double* x_dot, double* A,
                                     JointForces& forces) {
  const StateLayout& l = model.layout;
  if (!model.plain)
    return linearise_transmission<known>(model.transmission, l, time, in.history, in.command, in.external, x, x_dot, A,
                                         forces);
  set_plain_forces<known>(model, time, in, x, friction, cable, x_dot, forces.value);
  set_plain_slopes<known>(*model.plain, model.arm, l, friction, cable, A, forces);
}

/// The rows of A of the joints' rates. The slopes of the forces become those of F - (M a + h).
template <int known>
HALYARD_INLINE void set_joint_rows(const ArmParameters<double>& arm, const StateLayout& l, const ChainPoint& chain,
                                   JointForces& forces, double* A) {
  const int n = joint_count<known>(arm);
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) {
      forces.slope[k][l.position[i]] -= chain.slope[k][i];
      forces.slope[k][l.rate[i]] -= chain.slope[k][n + i];
    }
  for (int c = 0; c < l.size; ++c) {
    double column[kMaxJoints];
    for (int k = 0; k < n; ++k) column[k] = forces.slope[k][c];
    double accelerations[kMaxJoints];
    mobility_times(chain, n, column, accelerations);
    for (int k = 0; k < n; ++k) A[l.rate[k] + c * l.size] = accelerations[k];
  }
}

/// x_dot [size], A = ∂x'/∂x [size x size], column-major, and what is found besides. near: null, or what was found of
/// the chain at a state shortly before, from which M and the slopes are taken; it may be that of `point`. known: see
/// joint_count().
template <int known = 0>
HALYARD_INLINE void linearised_derivative(const LinearisedArm& model, double time, const HeldInputs& in,
                                          const double* x, const ChainPoint* near, double* x_dot, double* A,
                                          LinearisedPoint& point) {
  const ArmParameters<double>& arm = model.arm;
  const StateLayout& l = model.layout;
  const int n = joint_count<known>(arm);
  JointForces forces;
  linearise_forces<known>(model, time, in, x, point.friction, point.cable, x_dot, A, forces);
  ChainPoint& chain = point.chain;
  const ChainPose<double> pose = pose_at<known>(arm, l, x);
  if (!near) {
    set_mobility<known>(arm, pose, chain);
    for (int k = 0; k < n; ++k) chain.acceleration[k] = 0;
  } else if (near != &chain) {
    chain = *near;
  }
  if (model.plain) set_slopes(point.friction, point.cable, n, point.of_A);
  point.excess_rate = 0;
  for (int k = 0; k < n; ++k) point.force[k] = forces.value[k];
  set_accelerations<known>(arm, l, pose, x, forces.value, chain, x_dot);
  if (!near) set_chain_slopes<known>(arm, l, x, chain.acceleration, chain);
  set_joint_rows<known>(arm, l, chain, forces, A);
}

/// A at x, with the chain as it was found at a state shortly before.
template <int known>
HALYARD_INLINE void jacobian_beside(const LinearisedArm& model, double time, const HeldInputs& in, const double* x,
                                    const ChainPoint& chain, double* A) {
  JointForces forces;
  Frictions friction;
  CableForces cable;
  double x_dot[kMaxStates];
  linearise_forces<known>(model, time, in, x, friction, cable, x_dot, A, forces);
  set_joint_rows<known>(model.arm, model.layout, chain, forces, A);
}

}  // namespace halyard

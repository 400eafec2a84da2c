#pragma once
/// Routing past inboard pulleys lets one joint move several cables: the path of the cables is
/// s = R q, R = diag(r_l) C, and the joint forces return by virtual work: Γ = Rᵀ g.
///
///   s, g   length that each cable gives up to the joints, its force    [n_cable]   m, N
///   q, Γ   joint coordinate, force                                      [n_joint]   rad, N m | m, N
///   C      coupling matrix: C_kj is what joint j adds to cable k's path, C_kk = 1
///   r_l    link pulley radius                                           m | 1
///   R_k    row k of R; 0 outboard of joint k in a model file's arm
///
/// The paper gives the stretch (Eq. 8) but not the reaction Γ_j on the inboard joints; without it
/// the arm makes energy from nothing.
///
/// A rigid drive's cable does not stretch, (r_m / N) q_m = R_k q, so that
///
///   q_m = R_k q N / r_m         the motor follows the joints
///   Γ   = R_kᵀ τ N / r_m        the joints feel its torque τ
///   ΔM  = J R_kᵀ R_k (N/r_m)²   and carry its rotor, of inertia J

#include <Eigen/Core>

#include "transmission/arm_parameters.h"

namespace halyard {

/// R_kj of joint k.
template <class T>
HALYARD_INLINE T path_per_joint(const JointParameters<T>& joint_k, int j) {
  return joint_k.pulley_radius * joint_k.coupling[j];
}

/// Σ_j C_kj q_j: how far the joints move cable k, in units of joint k. q: [n]; works for rates as well.
template <class T>
HALYARD_INLINE T coupled_motion(const JointParameters<T>& joint_k, int n, const T* q) {
  T sum = 0.0;
  for (int j = 0; j < n; ++j) sum += joint_k.coupling[j] * q[j];
  return sum;
}

/// s = R q. q, s: [n]; works for rates as well.
template <class T>
HALYARD_INLINE void cable_path(const ArmParameters<T>& arm, const T* q, T* s) {
  for (int k = 0; k < arm.n; ++k) s[k] = arm.joint[k].pulley_radius * coupled_motion(arm.joint[k], arm.n, q);
}

/// Γ = Rᵀ g. g, force: [n].
template <class T>
HALYARD_INLINE void joint_reaction(const ArmParameters<T>& arm, const T* g, T* force) {
  for (int j = 0; j < arm.n; ++j) {
    T sum = 0.0;
    for (int i = 0; i < arm.n; ++i) sum += path_per_joint(arm.joint[i], j) * g[i];
    force[j] = sum;
  }
}

/// Adds R_kᵀ g of a single cable to force [n].
template <class T>
HALYARD_INLINE void add_cable_reaction(const ArmParameters<T>& arm, int k, const T& g, T* force) {
  const T pull = g * arm.joint[k].pulley_radius;
  for (int j = 0; j < arm.n; ++j) force[j] += arm.joint[k].coupling[j] * pull;
}

/// Motor angle of the rigidly driven joint k at joint positions q [n]; works for rates as well.
template <class T>
HALYARD_INLINE T rigid_motor(const ArmParameters<T>& arm, int k, const T* q) {
  const JointParameters<T>& j = arm.joint[k];
  return j.pulley_radius * coupled_motion(j, arm.n, q) / j.motor_travel();
}

/// Position of the rigidly driven joint k at its motor's angle, with the positions q [k] of the joints inboard of it,
/// which alone move its cable; works for rates as well.
template <class T>
HALYARD_INLINE T rigid_joint(const ArmParameters<T>& arm, int k, const T& motor_angle, const T* q) {
  const JointParameters<T>& joint = arm.joint[k];
  T position = joint.motor_travel() / joint.pulley_radius * motor_angle;
  for (int j = 0; j < k; ++j) position -= joint.coupling[j] * q[j];
  return position;
}

/// Adds what the rotors of rigid drives make of the mass matrix, J R_kᵀ R_k (N/r_m)².
template <class T>
HALYARD_INLINE void add_rotor_mass(const ArmParameters<T>& arm, T M[][kMaxJoints]) {
  for (int k = 0; k < arm.n; ++k) {
    const JointParameters<T>& j = arm.joint[k];
    if (j.drive != Drive::rigid) continue;
    const T turns = j.pulley_radius / j.motor_travel();
    for (int r = 0; r < arm.n; ++r)
      for (int c = 0; c < arm.n; ++c) M[r][c] += j.rotor_inertia * turns * turns * j.coupling[r] * j.coupling[c];
  }
}

/// R [n x n]; row i of a joint without drive is kept, though no cable follows it.
Eigen::MatrixXd path_matrix(const ArmParameters<double>& arm);

/// Kinematics without elasticity (Eq. 8 inverted): the q [n] at which no driven cable is
/// stretched, for motor angles q_m [n]. A joint without drive is taken to stand at q_undriven.
/// Throws std::invalid_argument if R of the driven joints is singular.
Eigen::VectorXd unstretched_joints(const ArmParameters<double>& arm, const Eigen::VectorXd& q_m,
                                   const Eigen::VectorXd& q_undriven);

/// The motor angles at which no cable is stretched at joint position q (Eq. 8).
Eigen::VectorXd unstretched_motors(const ArmParameters<double>& arm, const Eigen::VectorXd& q);

}  // namespace halyard

#pragma once
/// Cables are routed past inboard pulleys, so one joint moves several cables. The path of the cables is s = R q
/// with R = diag(r_l) C. The joint forces follow by virtual work: Γ = Rᵀ g.
///
///   s, g   for each cable: the length that the joints take up, and the force   [n_cable]   m, N
///   q, Γ   joint coordinate, force                                             [n_joint]   rad, N m | m, N
///   C      coupling matrix: C_kj is the motion of cable k per unit of motion of joint j, expressed as motion of
///          joint k; C_kk = 1
///   r_l    link pulley radius                                                              m | 1
///   R_k    row k of R; in arms from model files, R_kj = 0 for j > k (joints outboard of joint k do not move its cable)
///
/// The paper gives the stretch (Eq. 8) but not the reaction Γ_j on the inboard joints; without this reaction the arm
/// would create energy.
///
/// The cable of a rigid drive does not stretch: (r_m / N) q_m = R_k q. Therefore
///
///   q_m = R_k q N / r_m         the motor follows the joints
///   Γ   = R_kᵀ τ N / r_m        the joints feel its torque τ
///   ΔM  = J R_kᵀ R_k (N/r_m)²   and carry its rotor, of inertia J

#include <Eigen/Core>

#include "transmission/arm_parameters.h"

namespace halyard {

/// R_kj: path of cable k per unit of joint j.
template <class T>
HALYARD_INLINE T path_per_joint(const JointParameters<T>& joint_k, int j) {
  return joint_k.pulley_radius * joint_k.coupling[j];
}

/// Σ_j C_kj q_j: how far the joints move cable k, expressed as motion of joint k. q: [n]; works for rates as well.
template <class T>
HALYARD_INLINE T coupled_motion(const JointParameters<T>& joint_k, int n, const T* q) {
  T sum = 0.0;
  for (int j = 0; j < n; ++j) sum += joint_k.coupling[j] * q[j];
  return sum;
}

/// s = R q. q, s: [n]; works for rates as well.
template <int known = 0, class T>
HALYARD_INLINE void cable_path(const ArmParameters<T>& arm, const T* q, T* s) {
  const int n = joint_count<known>(arm);
  for (int k = 0; k < n; ++k) s[k] = arm.joint[k].pulley_radius * coupled_motion(arm.joint[k], n, q);
}

/// Γ = Rᵀ g. g, force: [n].
template <int known = 0, class T>
HALYARD_INLINE void joint_reaction(const ArmParameters<T>& arm, const T* g, T* force) {
  const int n = joint_count<known>(arm);
  for (int j = 0; j < n; ++j) {
    T sum = 0.0;
    for (int i = 0; i < n; ++i) sum += path_per_joint(arm.joint[i], j) * g[i];
    force[j] = sum;
  }
}

/// Adds R_kᵀ g of a single cable to force [n].
template <int known = 0, class T>
HALYARD_INLINE void add_cable_reaction(const ArmParameters<T>& arm, int k, const T& g, T* force) {
  const T pull = g * arm.joint[k].pulley_radius;
  for (int j = 0, n = joint_count<known>(arm); j < n; ++j) force[j] += arm.joint[k].coupling[j] * pull;
}

/// Motor angle of the rigidly driven joint k at joint positions q [n]; works for rates as well.
template <int known = 0, class T>
HALYARD_INLINE T rigid_motor(const ArmParameters<T>& arm, int k, const T* q) {
  const JointParameters<T>& j = arm.joint[k];
  return j.pulley_radius * coupled_motion(j, joint_count<known>(arm), q) / j.motor_travel();
}

/// Position of the rigidly driven joint k at a motor angle. q [k]: positions of the joints inboard of joint k; no other
/// joint moves its cable. Works for rates as well.
template <class T>
HALYARD_INLINE T rigid_joint(const ArmParameters<T>& arm, int k, const T& motor_angle, const T* q) {
  const JointParameters<T>& joint = arm.joint[k];
  T position = joint.motor_travel() / joint.pulley_radius * motor_angle;
  for (int j = 0; j < k; ++j) position -= joint.coupling[j] * q[j];
  return position;
}

/// Adds the inertia of the rigid drives' rotors to the mass matrix: J R_kᵀ R_k (N/r_m)² for each rotor.
template <int known = 0, class T>
HALYARD_INLINE void add_rotor_mass(const ArmParameters<T>& arm, T M[][kMaxJoints]) {
  const int n = joint_count<known>(arm);
  for (int k = 0; k < n; ++k) {
    const JointParameters<T>& j = arm.joint[k];
    if (j.drive != Drive::rigid) continue;
    const T turns = j.pulley_radius / j.motor_travel();
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) M[r][c] += j.rotor_inertia * turns * turns * j.coupling[r] * j.coupling[c];
  }
}

/// R [n x n]. It has a row also for a joint without a drive, though no cable belongs to that row.
Eigen::MatrixXd path_matrix(const ArmParameters<double>& arm);

/// Kinematics without elasticity (Eq. 8 inverted): the joint positions at which no driven cable is stretched. A joint
/// without a drive has a position of its own.
class UnstretchedJoints {
 public:
  /// Throws std::invalid_argument if R of the driven joints is singular.
  explicit UnstretchedJoints(const ArmParameters<double>& arm);
  /// q [n] of motor angles q_m [n]; an undriven joint gets its position from q_undriven [n].
  void solve(const Eigen::VectorXd& q_m, const Eigen::VectorXd& q_undriven, Eigen::VectorXd& q) const;

 private:
  Eigen::MatrixXd per_motor_, per_undriven_;  // ∂q/∂q_m, ∂q/∂q_undriven
};

/// The same for a single q_m.
Eigen::VectorXd unstretched_joints(const ArmParameters<double>& arm, const Eigen::VectorXd& q_m,
                                   const Eigen::VectorXd& q_undriven);

/// The motor angles q_m [n] at which no cable is stretched at joint positions q [n] (Eq. 8).
Eigen::VectorXd unstretched_motors(const ArmParameters<double>& arm, const Eigen::VectorXd& q);

}  // namespace halyard

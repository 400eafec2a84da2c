#include "estimators/process/static_equilibrium.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "model/output/number_text.h"
#include "transmission/coupling.h"
#include "transmission/jacobian.h"

namespace halyard {
namespace {

/// F(q) at rest and K = -∂F/∂q.
void rest_forces(const ProcessModel& process, double time_s, const Eigen::VectorXd& q_m,
                 const Eigen::VectorXd& external, const Eigen::VectorXd& z, const Eigen::VectorXd& q,
                 Eigen::VectorXd& F, Eigen::MatrixXd& K) {
  const Transmission<Dual>& transmission = process.dual_transmission();
  const int n = process.n_joints();
  Dual states[kMaxStates], rates[kMaxStates], zero[kMaxJoints];
  for (int i = 0; i < z.size(); ++i) states[i] = Dual(z(i));
  for (Dual& v : zero) v = Dual(0.0);
  const auto force_at = [&](const Dual* at, Dual* force) {
    JointSignals<Dual> s[kMaxJoints];
    Dual gravity[kMaxJoints];
    for (int k = 0; k < n; ++k) {
      s[k].motor_angle = q_m(k);
      s[k].joint_position = at[k];
      s[k].external_force = external(k);
    }
    transmission.evaluate(time_s, nullptr, states, s, rates);
    inverse_dynamics(transmission.arm(), chain_pose(transmission.arm(), at), zero, zero, gravity);
    for (int k = 0; k < n; ++k) force[k] = s[k].joint_force - gravity[k];
  };
  jacobian(force_at, q, F, K);
  K = -K;
}

/// B q = b.
struct HeldJoints {
  Eigen::MatrixXd B;
  Eigen::VectorXd b;
};

HeldJoints held_joints(const ArmParameters<double>& arm, const Eigen::VectorXd& q_m, const Eigen::VectorXd& start) {
  const Eigen::MatrixXd R = path_matrix(arm);
  HeldJoints held{Eigen::MatrixXd(arm.n, arm.n), Eigen::VectorXd(arm.n)};
  int count = 0;
  for (int k = 0; k < arm.n; ++k) {
    if (arm.joint[k].drive == Drive::cable) continue;
    const bool is_rigid = arm.joint[k].drive == Drive::rigid;
    if (is_rigid) held.B.row(count) = R.row(k);
    else held.B.row(count) = Eigen::RowVectorXd::Unit(arm.n, k);
    held.b(count++) = is_rigid ? arm.joint[k].motor_travel() * q_m(k) : start(k);
  }
  held.B.conservativeResize(count, arm.n);
  held.b.conservativeResize(count);
  return held;
}

Eigen::MatrixXd mass_matrix_at(const ArmParameters<double>& arm, const Eigen::VectorXd& q) {
  double M[kMaxJoints][kMaxJoints];
  mass_matrix(arm, chain_pose(arm, q.data()), M);
  add_rotor_mass(arm, M);
  Eigen::MatrixXd out(arm.n, arm.n);
  for (int r = 0; r < arm.n; ++r)
    for (int c = 0; c < arm.n; ++c) out(r, c) = M[r][c];
  return out;
}

}  // namespace

Eigen::VectorXd static_equilibrium(const ProcessModel& process, double time_s, const Eigen::VectorXd& motor_angle,
                                   const Eigen::VectorXd& external, const Eigen::VectorXd& z,
                                   const Eigen::VectorXd& start) {
  constexpr int kMaxIterations = 2000;
  constexpr double kFirstStep = 1e-4;   // s²: 1 mm or 1 mrad at the acceleration of gravity
  constexpr double kConverged = 1e-12;  // rad | m, far below any encoder
  constexpr double kBalanced = 1e-11;   // of the first acceleration: what is left are rounding errors
  const ArmParameters<double>& arm = process.arm();
  const int n = arm.n;

  const auto [B, b] = held_joints(arm, motor_angle, start);
  const auto n_h = b.size();

  Eigen::VectorXd q = start, F(n), rest(n + n_h), held = Eigen::VectorXd::Zero(n);  // held: Bᵀ λ
  Eigen::MatrixXd K(n, n), A = Eigen::MatrixXd::Zero(n + n_h, n + n_h);
  double first_acceleration = 0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    rest_forces(process, time_s, motor_angle, external, z, q, F, K);
    const Eigen::MatrixXd M = mass_matrix_at(arm, q);
    const double acceleration = M.llt().solve(F + held).norm();
    if (iteration == 0) first_acceleration = acceleration;
    // A joint that nothing holds has no position of its own, and rounding errors would move it for ever.
    else if (acceleration < kBalanced * first_acceleration) return q;
    const double delta = acceleration > 0 ? kFirstStep * first_acceleration / acceleration : 1 / kConverged;
    A.topLeftCorner(n, n) = K + M / delta;
    rest.head(n) = F;
    for (Eigen::Index r = 0; r < n_h; ++r) {
      A.row(n + r).head(n) = B.row(r);
      A.col(n + r).head(n) = -B.row(r).transpose();
      rest(n + r) = b(r) - B.row(r).dot(q);
    }
    const Eigen::VectorXd change = A.fullPivLu().solve(rest);
    if (!change.allFinite()) break;
    q += change.head(n);
    held.setZero();
    for (Eigen::Index r = 0; r < n_h; ++r) held += B.row(r).transpose() * change(n + r);
    if (change.head(n).cwiseAbs().maxCoeff() < kConverged) return q;
  }
  int k = 0;
  (F + held).cwiseAbs().maxCoeff(&k);
  throw std::runtime_error("static equilibrium: none found for the motor angles at " + with_digits(time_s, 12) +
                           " s: joint " + std::to_string(k + 1) + " is left with a force of " +
                           with_digits(F(k) + held(k), 6) +
                           "; check its cable's stiffness and the motor encoder's offset");
}

}  // namespace halyard

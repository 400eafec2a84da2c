#include <cmath>
#include <stdexcept>
#include <string>

#include "model/rigid_chain.h"
#include "plant/rigid_arm.h"
#include "transmission/jacobian.h"

namespace halyard {
namespace {

using SquareOfJoints = double[kMaxJoints][kMaxJoints];

/// M + M_rotors as ldl_factor() leaves it.
void factor_mass(const ArmParameters<double>& arm, const ChainPose<double>& pose, SquareOfJoints& M) {
  mass_matrix(arm, pose, M);
  add_rotor_mass(arm, M);
  ldl_factor<double, kMaxJoints>(arm.n, M);
}

/// Replaces the forces on the joints, F [n], by their accelerations: (M + M_rotors) q'' = F - h.
void accelerate(const ArmParameters<double>& arm, const ChainPose<double>& pose, const SquareOfJoints& M,
                const double* v, double* force) {
  const double zero[kMaxJoints] = {};
  double h[kMaxJoints];
  inverse_dynamics(arm, pose, v, zero, h);
  for (int k = 0; k < arm.n; ++k) force[k] -= h[k];
  ldl_solve<double, kMaxJoints>(arm.n, M, force);
}

/// As Simbody does.
void check_inertias(const ArmParameters<double>& arm) {
  for (int k = 0; k < arm.n; ++k) {
    const double* I = arm.joint[k].inertia;
    const double rounding = 1e-9 * (I[0] + I[1] + I[2]);
    for (int i = 0; i < 3; ++i)
      if (!(I[i] >= 0 && I[i] <= I[(i + 1) % 3] + I[(i + 2) % 3] + rounding))
        throw std::invalid_argument("link " + std::to_string(k + 1) +
                                    ": no body has this inertia: each of xx, yy, zz must be at most the sum of the "
                                    "others");
  }
}

class NewtonEulerArm : public RigidArm {
 public:
  explicit NewtonEulerArm(const DriveTrain& drive) : drive_(drive), slope_arm_(lift<Dual>(drive.arm())) {
    check_inertias(drive.arm());
  }

  void derivative(double time_s, const double* y, double* y_dot) override {
    const int n = arm().n;
    drive_.rates(DriveTerms::all, time_s, y, y + n, y + 2 * n, y_dot + n, y_dot + 2 * n);
    for (int k = 0; k < n; ++k) y_dot[k] = y[n + k];
    SquareOfJoints M;
    const ChainPose<double> pose = chain_pose(arm(), y);
    factor_mass(arm(), pose, M);
    accelerate(arm(), pose, M, y + n, y_dot + n);
    if (!Eigen::Map<const Eigen::VectorXd>(y_dot, drive_.layout().size()).allFinite())
      throw std::runtime_error("a rate of the arm's state is not finite");
  }

  /// From (M + M_rotors) q'' + h = F: M ∂q'' = ∂F - ∂(M q'' + h) at fixed q''. Rotors have a constant M_rotors.
  void jacobian(double time_s, const double* y, const double* y_dot, Eigen::Ref<Eigen::MatrixXd> J) override {
    const int n = arm().n, n_z = drive_.layout().n_z;
    drive_.slopes(DriveTerms::all, time_s, y, y + n, y + 2 * n, slopes_);
    slopes_.topLeftCorner(n, 2 * n) -= force_slopes(y, y_dot + n);
    SquareOfJoints M;
    factor_mass(arm(), chain_pose(arm(), y), M);

    J.topLeftCorner(n, n).setZero();
    J.block(0, n, n, n).setIdentity();
    J.topRightCorner(n, n_z).setZero();
    for (Eigen::Index c = 0; c < J.cols(); ++c) {
      double column[kMaxJoints];
      for (int k = 0; k < n; ++k) column[k] = slopes_(k, c);
      ldl_solve<double, kMaxJoints>(n, M, column);
      for (int k = 0; k < n; ++k) J(n + k, c) = column[k];
    }
    J.bottomRows(n_z) = slopes_.bottomRows(n_z);
  }

  const Eigen::MatrixXd& total_mass(double, const double* y) override {
    double M[kMaxJoints][kMaxJoints];
    mass_matrix(arm(), chain_pose(arm(), y), M);
    add_rotor_mass(arm(), M);
    total_.resize(arm().n, arm().n);
    for (int r = 0; r < arm().n; ++r)
      for (int c = 0; c < arm().n; ++c) total_(r, c) = M[r][c];
    return total_;
  }

  Eigen::VectorXd holding_force(const Eigen::VectorXd& q) override {
    return force_of(q, Eigen::VectorXd::Zero(q.size()));
  }

  Eigen::VectorXd velocity_force(const Eigen::VectorXd& q, const Eigen::VectorXd& v) override {
    return force_of(q, v) - holding_force(q);
  }

  Eigen::Vector3d position_of(const double* point, const Eigen::VectorXd& q) override {
    Eigen::Vector3d at;
    halyard::position_of(arm(), chain_pose(arm(), q.data()), point, at.data());
    return at;
  }

  double energy(double time_s, const double* y) override {
    const int n = arm().n;
    const Eigen::Map<const Eigen::VectorXd> v(y + n, n);
    return 0.5 * v.dot((total_mass(time_s, y) - drive_.rotor_mass()) * v) + gravity_energy(y);
  }

 private:
  const ArmParameters<double>& arm() const { return drive_.arm(); }

  /// h(q, v) with gravity.
  Eigen::VectorXd force_of(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(q.size());
    Eigen::VectorXd force(q.size());
    inverse_dynamics(arm(), chain_pose(arm(), q.data()), v.data(), zero.data(), force.data());
    return force;
  }

  /// ∂(M(q) a + h(q, v)) / ∂[q, v] at fixed a, [n x 2 n].
  const Eigen::MatrixXd& force_slopes(const double* q_and_v, const double* a) {
    const int n = arm().n;
    Dual fixed[kMaxJoints];
    for (int k = 0; k < n; ++k) fixed[k] = a[k];
    const auto force = [&](const Dual* at, Dual* out) {
      inverse_dynamics(slope_arm_, chain_pose(slope_arm_, at), at + n, fixed, out);
    };
    force_.resize(n);
    force_slopes_.resize(n, 2 * n);
    halyard::jacobian(force, Eigen::Map<const Eigen::VectorXd>(q_and_v, 2 * n), force_, force_slopes_);
    return force_slopes_;
  }

  double gravity_energy(const double* q) const {
    const ChainPose<double> pose = chain_pose(arm(), q);
    double energy = 0;
    for (int link = 0; link < arm().n; ++link) {
      const JointParameters<double>& j = arm().joint[link];
      double at[3] = {j.com[0], j.com[1], j.com[2]};
      for (int i = link; i >= 0; --i) {
        double out[3];
        into_parent(pose.R[i], at, out);
        for (int r = 0; r < 3; ++r) at[r] = out[r] + pose.p[i][r];
      }
      for (int r = 0; r < 3; ++r) energy -= j.mass * arm().gravity[r] * at[r];
    }
    return energy;
  }

  const DriveTrain& drive_;
  ArmParameters<Dual> slope_arm_;
  Eigen::MatrixXd total_, slopes_, force_slopes_;
  Eigen::VectorXd force_;
};

}  // namespace

std::unique_ptr<RigidArm> make_newton_euler_arm(const DriveTrain& drive) {
  return std::make_unique<NewtonEulerArm>(drive);
}

}  // namespace halyard

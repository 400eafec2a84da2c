#include <algorithm>

#include "model/rigid_chain.h"
#include "plant/lanes/plant_kernels.h"
#include "plant/rigid_arm.h"

namespace halyard {
namespace {

class NewtonEulerArm : public RigidArm {
 public:
  explicit NewtonEulerArm(const DriveTrain& drive) : drive_(drive), kernels_(plant_kernels().front()) {}

  void derivative(double time_s, const double* y, double* y_dot) override {
    const int n = arm().n;
    drive_.rates(DriveTerms::all, time_s, y, y + n, y + 2 * n, y_dot + n, y_dot + 2 * n);
    kernels_.accelerate(arm(), y, y + n, y_dot + n);
    std::copy_n(y + n, n, y_dot);
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
  const PlantKernels& kernels_;
  Eigen::MatrixXd total_;
};

}  // namespace

std::unique_ptr<RigidArm> make_newton_euler_arm(const DriveTrain& drive) {
  return std::make_unique<NewtonEulerArm>(drive);
}

}  // namespace halyard

#pragma once
/// Inside plant/: the only header that includes Simbody. Include it from files that are compiled as C++17 and with
/// -UNDEBUG; plant/CMakeLists.txt lists these files, docs/architecture.md gives the reason.

#include <Simbody.h>

#include "plant/rigid_arm.h"

namespace halyard {

/// The chain as a Simbody System whose State holds all of y: q, u, and z as auxiliary variables. Simbody's own
/// integrators take the whole System. derivative() takes Simbody's kinematics, forces of gravity and velocity, and mass
/// matrix, and solves for the accelerations: realizing the System up to them costs twice as much.
class SimbodyArm : public RigidArm {
 public:
  explicit SimbodyArm(const DriveTrain& drive);

  void derivative(double time_s, const double* y, double* y_dot) override;
  const Eigen::MatrixXd& total_mass(double time_s, const double* y) override;
  Eigen::VectorXd holding_force(const Eigen::VectorXd& q) override;
  Eigen::VectorXd velocity_force(const Eigen::VectorXd& q, const Eigen::VectorXd& v) override;
  Eigen::Vector3d position_of(const double* point, const Eigen::VectorXd& q) override;
  double energy(double time_s, const double* y) override;

  /// M + M_rotors at the state's q.
  const Eigen::MatrixXd& total_mass(const SimTK::State& s) const;
  /// Replaces the forces on the joints, F [n], by their accelerations: (M + M_rotors) q'' = F - h, h with gravity. The
  /// state must be realized up to Stage::Velocity.
  void accelerate(const SimTK::State& s, double* force) const;

  const DriveTrain& drive;
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::Force::Gravity gravity;
  SimTK::State state;

 private:
  /// Copies q and u of y into the state and realizes it.
  void realize(const double* y, SimTK::Stage stage);

  const SimTK::Vector no_acceleration_;  ///< empty: zero
  mutable SimTK::Vector force_, residual_;
  mutable SimTK::Matrix M_;
  mutable Eigen::MatrixXd total_;
};

}  // namespace halyard

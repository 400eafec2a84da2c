#pragma once
/// Inside plant/: the rigid chain of an ArmPlant, moved by its drive train. Each engine computes it on its own:
/// SimbodyArm with Simbody, NewtonEulerArm with halyard's equations of model/rigid_chain.h.

#include <Eigen/Core>
#include <memory>

#include "plant/drive_train.h"

namespace halyard {

class RigidArm {
 public:
  virtual ~RigidArm() = default;

  /// y' at the state y, both [size of the layout].
  virtual void derivative(double time_s, const double* y, double* y_dot) = 0;

  /// M + M_rotors at the state y, [n x n]; valid until the next call.
  virtual const Eigen::MatrixXd& total_mass(double time_s, const double* y) = 0;
  /// Joint forces that hold the chain against gravity.
  virtual Eigen::VectorXd holding_force(const Eigen::VectorXd& q) = 0;
  /// h without gravity.
  virtual Eigen::VectorXd velocity_force(const Eigen::VectorXd& q, const Eigen::VectorXd& v) = 0;
  /// Position in the base frame of a point [3] of the last link, m.
  virtual Eigen::Vector3d position_of(const double* point, const Eigen::VectorXd& q) = 0;
  /// Kinetic and gravity energy of the chain without rotors, J; the zero of gravity's energy is arbitrary.
  virtual double energy(double time_s, const double* y) = 0;
};

/// The drive train must outlive the arm. Both throw std::invalid_argument for inertias that no body has.
std::unique_ptr<RigidArm> make_simbody_arm(const DriveTrain& drive);
std::unique_ptr<RigidArm> make_newton_euler_arm(const DriveTrain& drive);

}  // namespace halyard

#pragma once
/// The arm as a system of differential equations: a rigid chain, moved by a drive train.
///
///   (M(q) + M_rotors) q'' + h(q, q') = F(q, q', z),   z' from the drive train
///
///   y     state [q, q', z]; see PlantLayout        [size]
///   M     mass matrix of the chain                  [n x n]
///   h     velocity and gravity forces                [n]
///
/// Each joint has one mobilized body. The body turns about, or slides along, the z axis of its own frame. A rigid
/// drive's rotor enters as the force -M_rotors q'' on the chain. Only one thread at a time may use an ArmPlant.

#include <Eigen/Core>
#include <memory>

#include "plant/drive_train.h"
#include "plant/engine.h"

namespace halyard {

class RigidArm;

class ArmPlant {
 public:
  /// Throws std::invalid_argument as DriveTrain does, and for link inertias that are physically impossible.
  explicit ArmPlant(const ArmParameters<double>& nominal, const std::vector<PlacedEffect>& effects = {},
                    Engine engine = Engine::simbody);
  ~ArmPlant();

  const DriveTrain& drive() const { return drive_; }
  const PlantLayout& layout() const { return drive_.layout(); }

  /// Sets the commanded motor torques and external loads on the joints, [n] each, that hold from time_s on.
  void set_inputs(double time_s, const double* command, const double* external);

  /// Throws std::runtime_error if a rate is not finite, as jacobian() does.
  void derivative(double time_s, const double* y, double* y_dot);
  /// y' and J = ∂y'/∂y, exact; J: [size x size]. The derivatives of the chain are halyard's own with either engine,
  /// because Simbody has none.
  void jacobian(double time_s, const double* y, double* y_dot, Eigen::Ref<Eigen::MatrixXd> J);
  /// The part of y' that comes from these terms of the drive. It contains q' = v for the joints that the terms move,
  /// and q' = 0 for the others.
  void derivative_of_terms(DriveTerms terms, double time_s, const double* y, double* y_dot);
  /// Jacobian of derivative_of_terms at fixed M and h: [0 I; M⁻¹ ∂F; ∂z']. Exact for the stiff terms. J: [size x size].
  void jacobian_of_terms(DriveTerms terms, double time_s, const double* y, Eigen::Ref<Eigen::MatrixXd> J);

  /// M of the chain without rotors, [n x n].
  Eigen::MatrixXd mass_matrix(const Eigen::VectorXd& q);
  /// Joint forces that hold the chain against gravity.
  Eigen::VectorXd holding_force(const Eigen::VectorXd& q);
  /// h without gravity.
  Eigen::VectorXd velocity_force(const Eigen::VectorXd& q, const Eigen::VectorXd& v);

  /// Position in the base frame of a point of the last link, m. point: [3] in the last link's frame, m.
  Eigen::Vector3d position_of(const double* point, const Eigen::VectorXd& q);

  /// Kinetic, gravity and elastic energy, J; the zero of gravity's energy is arbitrary.
  double stored_energy(double time_s, const double* y);

  /// Number of calls of derivative(), those of the integrators included.
  long derivative_evaluations() const { return evaluations_; }
  void count_evaluations(long n) { evaluations_ += n; }

  /// For the integrators of one engine: plant/rigid_arm.h.
  RigidArm& chain() { return *chain_; }

 private:
  DriveTrain drive_;
  Engine engine_;
  std::unique_ptr<RigidArm> chain_;
  long evaluations_ = 0;
};

}  // namespace halyard

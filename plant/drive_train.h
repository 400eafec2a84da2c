#pragma once
/// The plant without its rigid chain: motors, transmission with effects, and two energy meters.
///
///   drives        cable, rigid or none, as in transmission/drive.h; the chain carries the rotors of rigid drives
///   meters        E_in' = Σ τ_c ω + Σ F_e q'
///                 E_lost' = (power into motors, cables and joints) - (power out of them)
///                           - (power stored in stretched cables)
///
///   τ_c    torque at the shaft after the command stage, before friction               N m
///   F_e    external load on a joint                                                     N m | N
///   z      [q_m, ω of each cable drive; internal states of the effects; E_in, E_lost]    [n_z]
///
/// Stored in a stretched cable is the energy of its elastic stretch x_e (cable_energy()). Its power is g(x_e, 0) x_e',
/// where x_e' contains what the effects' states change, such as that of creep.
///
/// The work of an effect that acts at the joint, such as the effect external_force, counts in E_lost and not in E_in.
/// It is positive if the effect takes energy from the arm, and negative if it adds energy. What an effect itself
/// stores, in bristles or in the slow part of creep, counts in E_lost until it comes back.

#include <Eigen/Core>
#include <vector>

#include "plant/lanes/plant_kernels.h"
#include "plant/lanes/plant_layout.h"

namespace halyard {

class DriveTrain {
 public:
  /// Throws std::invalid_argument if a cable drive's rotor has no inertia, or the effects have too many states.
  DriveTrain(const ArmParameters<double>& nominal, const std::vector<PlacedEffect>& effects);

  const PlantLayout& layout() const { return model_.layout; }
  /// For plant_kernels().
  const DriveModel& model() const { return model_; }
  /// The parameters with the changes that the effects make to them.
  const ArmParameters<double>& arm() const { return model_.transmission.arm(); }
  const Transmission<double>& transmission() const { return model_.transmission; }

  /// Sets the commanded motor torques and external loads on the joints, [n] each, that hold from time_s on.
  void set_inputs(double time_s, const double* command, const double* external);

  /// Computes joint_force [n] and z_dot [n_z] at q, v [n], z [n_z].
  void rates(DriveTerms terms, double time_s, const double* q, const double* v, const double* z, double* joint_force,
             double* z_dot) const;

  /// Exact derivatives of rates(): rows joint_force and z_dot, columns q, v, z; [n + n_z x size].
  /// Nothing depends on the meters: their columns are 0.
  void slopes(DriveTerms terms, double time_s, const double* q, const double* v, const double* z,
              Eigen::MatrixXd& slopes) const;
  /// rates() and slopes() at the state y [size]: joint_force and z_dot into entries n.. of y_dot [size], and their
  /// slopes into rows n.. of J [size x size]. Leaves the first n entries and rows.
  void linearise(DriveTerms terms, double time_s, const double* y, double* y_dot, Eigen::Ref<Eigen::MatrixXd> J) const;

  /// The signals of all joints, sensor errors included; s: [n]. The joints' accelerations in s are an input.
  void signals(double time_s, const double* q, const double* v, const double* z, JointSignals<double>* s) const;

  /// M_rotors, the contribution of rigid drives' rotors to the mass matrix, [n x n]; zero if there are none.
  const Eigen::MatrixXd& rotor_mass() const { return rotor_mass_; }

  /// Elastic energy of the cables plus kinetic energy of the rotors, J.
  double stored_energy(double time_s, const double* q, const double* v, const double* z) const;

 private:
  DriveModel model_;
  const PlantKernels& kernels_;
  Eigen::MatrixXd rotor_mass_;
};

}  // namespace halyard

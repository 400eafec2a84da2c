#pragma once
/// How much the filters trust encoders and model: one rule for every arm, from what its model says of itself.
///
///   encoder        σ_z = max(resolution / √12, 1e-5 rad)                                  (rounding is uniform)
///   torque         σ_τ = t_f F_c,m                                     N m at the shaft
///   joint force    σ_F = t_f F_c,q + t_m max |gravity force|            N m | N
///   effect states  each wanders by its scale within `effect_noise_time`, 1e4 s: they follow equations of their own,
///                  and motors hardly show them (slow creep with 10 s: joint errors of several times the stretch)
///
///   t_f, t_m   the model's tolerances of friction and masses: what it may be wrong by without being another model
///   F_c,m, F_c,q   Coulomb levels of motor and joint
///
/// A model that is wrong stays wrong for a while: the errors of torque and force have a correlation time τ, and a
/// filter with white noise needs the spectral density 2 σ² τ for them. Over a step dt they act as a constant
/// acceleration of that density (Bar-Shalom, Li, Kirubarajan 2001, section 6.3.2):
///
///   Q_root = [½ dt² ; dt] B σ √(2 τ / dt),   B: accelerations of motors and joints per torque and force
///
/// τ = 1 ms by default. With it νᵀS⁻¹ν of the RAVEN-II's three motors, which ought to be 3, is 2.6 where the model is
/// exact and 2.7 to 3.2 where all frictions or masses are off by their tolerances; with 0.1 ms it is 2.8 and 3.5 to 8.5,
/// with 10 ms 2.3 in all cases. Joint errors on exact records hardly change from 0.01 to 10 ms.
///
/// The start is at rest in static equilibrium. How far gravity stretches the cables, and how far friction may hold the
/// joints off, is uncertain: σ of the stretch = t_s |x| + F_c,q / (√3 K), K the stiffness of the cable.

#include <Eigen/Core>

#include "estimators/estimator_options.h"
#include "estimators/process_model.h"

namespace halyard {

struct NoiseLevels {
  Eigen::VectorXd encoder;        ///< [n] rad
  Eigen::VectorXd torque;         ///< [n] N m
  Eigen::VectorXd joint_force;    ///< [n] N m | N
  double correlation_time = 0;    ///< τ, s
  Eigen::VectorXd wander;         ///< [n_effect_states] of effect states, own unit per √s
};

/// The rule above, overridden by the options encoder_noise, torque_noise, joint_force_noise (per joint), noise_time and
/// effect_noise_time.
NoiseLevels read_noise(OptionReader& options, const ArmModel& model, const ProcessModel& process);

/// Roots of the noise covariances of an arm.
class ArmNoise {
 public:
  ArmNoise(const ArmModel& model, const ProcessModel& process, const NoiseLevels& levels);

  /// Q_root [n_states x sources] of a step.
  const Eigen::MatrixXd& process_root(double dt_s);
  /// σ_z [n].
  const Eigen::VectorXd& encoder() const { return levels_.encoder; }
  /// S [n_states x n_states] at rest in equilibrium at x.
  Eigen::MatrixXd initial_root(const Eigen::VectorXd& x) const;

 private:
  const ProcessModel& process_;
  NoiseLevels levels_;
  Eigen::VectorXd effect_scale_;
  Eigen::VectorXd tolerance_, friction_stretch_, undriven_;
  Eigen::MatrixXd rate_, position_;   // per √s and per √s³: Q_root = rate √dt + position √dt³
  Eigen::MatrixXd Q_root_;
};

}  // namespace halyard

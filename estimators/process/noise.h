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
/// filter with white noise needs the spectral density 2 σ² τ for them. Over a step dt they act as a constant force of
/// that density, by Simpson's rule as impulses before, amid and after the step:
///
///   Q_root = (Δ_dt + 4 Δ_dt/2 + G) / 6,   Δ_h = f_h(x + G) - f_h(x),   G = B σ √(2 τ dt)
///
///   f_h   the process model's step of length h        B   accelerations of motors and joints per torque and force
///
/// Where nothing damps within a step this is [½ dt² ; dt] B σ √(2 τ / dt) (Bar-Shalom, Li, Kirubarajan 2001, section
/// 6.3.2). A cable's damper with a rate λ of some 1/dt carries a joint only 1/λ per unit of speed instead: that formula
/// had the RAVEN-II's third joint (λ = 2000 1/s, dt = 1 ms) wander twice as far as it does, this one has it right.
///
/// τ = 1 ms by default. With it νᵀS⁻¹ν of the RAVEN-II's three motors in the paper's experiment A, which ought to be 3,
/// is 2.6 where the model is exact, 2.7 where all masses are off by their tolerance, and 7 to 12 where all frictions
/// are; with 0.1 ms it is 2.8, 3.3 and 47 to 96, with 10 ms 2.4, 2.4 and 2.7 to 3.3. From 0.1 to 10 ms joint errors
/// grow fourfold where the model is exact, and twofold where frictions are off.
///
/// By hand, as the paper does: the options below, per joint. Adapted to the record: with an adaptation time T > 0 the
/// deviations of motor k's torque and joint k's force are c_k times the levels, and each innovation moves
///
///   ln c_k² += dt / T (min(ν_k² / S_kk, 9) - 1),   1/30 <= c_k <= 30
///
/// so that innovations become as large as they are said to be (covariance matching, Mehra 1972). What the motors do not
/// show, an error of the joint behind a stiff cable, it cannot find.
///
/// The start is at rest in static equilibrium. How far gravity stretches the cables, and how far friction may hold the
/// joints off, is uncertain: σ of the stretch = t_s |x| + F_c,q / (√3 K), K the stiffness of the cable.

#include <Eigen/Core>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/estimator_options.h"
#include "estimators/process/process_model.h"

namespace halyard {

struct NoiseLevels {
  Eigen::VectorXd encoder;      ///< [n] rad
  Eigen::VectorXd torque;       ///< [n] N m
  Eigen::VectorXd joint_force;  ///< [n] N m | N
  double correlation_time = 0;  ///< τ, s
  double adaptation_time = 0;   ///< T, s; 0: none
  Eigen::VectorXd wander;       ///< [n_effect_states] of effect states, own unit per √s
};

/// The rule above, overridden by the options encoder_noise, torque_noise, joint_force_noise (per joint), noise_time,
/// effect_noise_time and adaptation_time.
NoiseLevels read_noise(OptionReader& options, const ArmModel& model, const ProcessModel& process);

/// Roots of the noise covariances of an arm. Not for two threads at a time.
class ArmNoise {
 public:
  ArmNoise(const ArmModel& model, const ProcessModel& process, const NoiseLevels& levels);

  /// Q_root [n_states x sources] of a step that begins at x.
  const Eigen::MatrixXd& process_root(const Step& step, const Eigen::VectorXd& x);
  /// Learns from the innovation of these motors, dt_s after the one before.
  void adapt(const std::vector<int>& motors, const Innovation& innovation, double dt_s);
  /// What was learnt, c [n]: 1 at first.
  const Eigen::VectorXd& adapted() const { return adapted_; }
  void reset(const Eigen::VectorXd& adapted) { adapted_ = adapted; }
  /// σ_z [n].
  const Eigen::VectorXd& encoder() const { return levels_.encoder; }
  /// S [n_states x n_states] in equilibrium at x; rates are at rest, or from two readings dt_s apart: infinite, or
  /// finite.
  Eigen::MatrixXd initial_root(const Eigen::VectorXd& x, double dt_s) const;

 private:
  const ProcessModel& process_;
  NoiseLevels levels_;
  Eigen::VectorXd effect_scale_;
  Eigen::VectorXd tolerance_, friction_stretch_, undriven_;
  Eigen::VectorXd adapted_;
  Eigen::MatrixXd G_, points_, Q_root_;
};

}  // namespace halyard

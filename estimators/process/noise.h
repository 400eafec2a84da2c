#pragma once
/// Noise of encoders and process model in the filters: one rule for every arm, from the data of its model.
///
///   encoder        σ_z = max(√(resolution² / 12 + noise²), 1e-5 rad)                      (rounding is uniform)
///   torque         σ_τ = t_f F_c,m                                     N m at the shaft
///   joint force    σ_F = t_f F_c,q + t_m max |gravity force|            N m | N
///   effect states  a random walk whose standard deviation reaches the typical size of the state after
///                  `effect_noise_time`, 1e4 s. The motor encoders hardly observe these states. With the slow effect
///                  `creep`, an `effect_noise_time` of only 10 s gave joint errors of several times the cable's
///                  stretch
///
///   t_f, t_m       the model's relative tolerances of friction and masses
///   F_c,m, F_c,q   Coulomb levels of motor and joint
///
/// Model errors persist: the errors of torque and force have a correlation time τ. A filter with white noise needs the
/// spectral density 2 σ² τ for them. Over a step dt they are modelled as a constant force whose variance is this
/// density divided by dt. Simpson's rule replaces it by impulses at the start, middle and end of the step:
///
///   Q_root = (Δ_dt + 4 Δ_dt/2 + G) / 6,   Δ_h = f_h(x + G) - f_h(x),   G = B σ √(2 τ dt)
///
///   f_h   the process model's step of length h        B   accelerations of motors and joints per torque and force
///
/// An exponential step whose guard accepts it takes Δ from its own matrix exponentials (Γ of exponential_step.h).
///
/// Without damping within a step this is [½ dt² ; dt] B σ √(2 τ / dt) (Bar-Shalom, Li, Kirubarajan 2001, section
/// 6.3.2). That formula is wrong where a cable's damper has a rate λ of the order of 1/dt, because a joint then moves
/// only 1/λ per unit of speed. For the RAVEN-II's third joint (λ = 2000 1/s, dt = 1 ms) it gives twice the correct
/// standard deviation.
///
/// τ = 1 ms by default. νᵀS⁻¹ν of the RAVEN-II's three motors in the paper's experiment A, with an expected value of 3:
///
///   τ         exact model   all masses wrong by their tolerance   all frictions wrong by their tolerance
///   0.1 ms    2.8           3.3                                   47 to 96
///   1 ms      2.6           2.7                                   7 to 12
///   10 ms     2.4           2.4                                   2.7 to 3.3
///
/// A torque that is held without a newer command is more uncertain: its impulse over the step (held_torques.h) adds to
/// G.
///
/// When τ increases from 0.1 to 10 ms, joint errors grow fourfold with the exact model and twofold with wrong
/// frictions.
///
/// The options below set the levels per joint, as the paper does. With an adaptation time T > 0 the levels adapt to the
/// record: the standard deviations of motor k's torque and joint k's force are c_k times the levels, and each
/// innovation updates
///
///   ln c_k² += dt / T (min(ν_k² / S_kk, 9) - 1),   1/30 <= c_k <= 30
///
/// so that the innovations match their predicted covariance (covariance matching, Mehra 1972). Adaptation cannot find
/// errors that the motors do not observe, such as those of a joint behind a stiff cable.
///
/// The start is at rest in static equilibrium. The stretch x of the cables is uncertain: their stiffness, 2 K of both
/// ways, is uncertain, and friction may hold the joints away from equilibrium. With the encoder, σ of the path that the
/// joints take up is t_s |x| + F_c,q / (√3 2 K r_l) + (r_m / N) σ_z, where t_s is the model's relative tolerance of
/// stiffness and r_l the radius of the link's pulley. For a joint without a motor, σ is a tenth of its range.

#include <Eigen/Core>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/estimator_options.h"
#include "estimators/process/exponential_step.h"
#include "estimators/process/process_model.h"

namespace halyard {

/// √(resolution² / 12 + noise²), unit of the reading.
double reading_deviation(double resolution, double noise);

struct NoiseLevels {
  Eigen::VectorXd encoder;      ///< [n] rad
  Eigen::VectorXd torque;       ///< [n] N m
  Eigen::VectorXd joint_force;  ///< [n] N m | N
  double correlation_time = 0;  ///< τ, s
  double adaptation_time = 0;   ///< T, s; 0: none
  Eigen::VectorXd wander;       ///< [n_effect_states] random-walk intensity of effect states, own unit per √s
};

/// The rule above, overridden by the options encoder_noise, torque_noise, joint_force_noise (per joint), noise_time,
/// effect_noise_time and adaptation_time.
NoiseLevels read_noise(OptionReader& options, const ArmModel& model, const ProcessModel& process);

/// Roots of the noise covariances of an arm. Not thread-safe.
class ArmNoise {
 public:
  ArmNoise(const ArmModel& model, const ProcessModel& process, const NoiseLevels& levels);

  /// G [n_states x 2 n_joints] of a step that starts where M(q)⁻¹ is `mobility`.
  const Eigen::MatrixXd& impulses(const Step& step, const Eigen::Ref<const Eigen::MatrixXd>& mobility);
  /// Q_root [n_states x sources] of a step that starts at x. exponential: the same step, if it has been started with
  /// its impulses().
  const Eigen::MatrixXd& process_root(const Step& step, const Eigen::VectorXd& x,
                                      ExponentialStep* exponential = nullptr);
  /// Adapts c to an innovation of these motors; dt_s [m]: of each, the time since its innovation before, s.
  void adapt(const std::vector<int>& motors, const Innovation& innovation, const ReadingVector& dt_s);
  /// The adapted factors c [n], initially 1.
  const Eigen::VectorXd& adapted() const { return adapted_; }
  void reset(const Eigen::VectorXd& adapted) { adapted_ = adapted; }
  /// σ_z [n].
  const Eigen::VectorXd& encoder() const { return levels_.encoder; }
  /// S [n_states x n_states] in equilibrium at x. dt_s infinite: at rest; finite: rates come from two readings dt_s
  /// apart, s.
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

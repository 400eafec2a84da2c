#pragma once
/// A filter that estimates unknown forces on the joints from the motors' signals: the arm's state is augmented by one
/// force d_k for each joint that has a motor.
///
///   M(q) q'' + h(q, q') = F + d,   d' = w_d,   w_d ~ N(0, ρ² δ(t))         d(0) ~ N(0, σ_d²)
///
///   d     force that acts on the joint and that the model lacks; positive if it pushes the joint forward   N m | N
///   ρ     intensity of its random walk: `force_wander`                                          N m/√s | N/√s
///   σ_d   standard deviation at the start: `force_start`                                        N m | N
///
/// Defaults: σ_d = max(G, F_c) and ρ = max(2 F_c, G / 4) / √s, where G is the largest gravity force on the joint over
/// its range and F_c its Coulomb friction. A larger ρ amplifies the encoders' rounding: on the RAVEN-II's shoulder at
/// rest the error is 0.18 N m with 4 N m/√s, 0.05 with 1, 0.015 with 0.25. A smaller ρ makes the estimate lag: with
/// 0.25 N m/√s, the estimate of a step of 1.5 N m is still a fifth too small after 0.1 s.
///
/// d is the sum of all forces that the model lacks: an error of friction, mass or torque constant appears as a force on
/// the joint. In the process model, regularised friction lets a joint creep at standstill. So a force reaches the cable
/// within about 20 ms. Where real friction sticks, a force below its Coulomb level never reaches the motor and cannot
/// be observed.
///
/// Extra outputs:
///
///   joint_force, joint_force_std   d and its standard deviation                                  N m | N
///   cable_force                    g of each joint's cable, the tension difference of its runs   N
///
/// Sources: state augmentation: Jazwinski, "Stochastic Processes and Filtering Theory", 1970, section 8.4; disturbance
/// observers: Chen, Yang, Guo, Li, IEEE Trans. Industrial Electronics 63 (2016).

#include "estimators/filters/unknown_constant.h"

namespace halyard {

/// The defaults above, overridden by the options force_start and force_wander (per joint).
UnknownLevels read_force_levels(OptionReader& options, const ArmModel& model);

/// The model with one more effect for each joint that has a motor: an unknown force on the joint. These effects are the
/// last of the model.
ArmModel with_unknown_forces(const ArmModel& model, const UnknownLevels& levels);

/// Adds ρ of the forces to the noise in `options`. `process` is the process model of a model from
/// with_unknown_forces().
ArmFilterOptions with_force_wander(ArmFilterOptions options, const ProcessModel& process, const UnknownLevels& levels);

class DisturbanceFilter final : public Estimator {
 public:
  /// `augmented` is a model from with_unknown_forces(), and `process` is its process model.
  DisturbanceFilter(const ArmModel& augmented, std::shared_ptr<const ProcessModel> process, ArmFilterOptions options,
                    const UnknownLevels& levels, std::unique_ptr<GaussianFilter> filter);

  void reset(const Sample& first) override;
  Innovation update(const Sample& sample) override;
  Estimate estimate() const override;
  std::vector<std::string> extra_output_names() const override {
    return {"joint_force", "joint_force_std", "cable_force"};
  }
  EstimatorReport report() const override { return filter_.report(); }

 private:
  std::shared_ptr<const ProcessModel> process_;
  ArmFilter filter_;
  double time_ = 0;
};

}  // namespace halyard

#pragma once
/// Kinematics without elasticity, what the arm's own software does: joint positions from motor angles by Eq. 8
/// inverted, q = R⁻¹ (r_m / N) q_m (coupling.h), velocities by differences of successive samples.

#include "estimators/estimator.h"
#include "model/arm_model.h"

namespace halyard {

/// A motor whose sample is missing keeps its last angle, at first the one of home; a joint without motor is taken to
/// stand at home. There is no correction: innovations are empty.
class KinematicsEstimator final : public Estimator {
 public:
  explicit KinematicsEstimator(const ArmModel& model);

  void reset(const Sample& first) override;
  /// Throws std::invalid_argument if time does not increase.
  Innovation update(const Sample& sample) override;
  Estimate estimate() const override { return estimate_; }
  EstimatorReport report() const override { return report_; }

 private:
  Eigen::VectorXd joint_position(const Sample& sample);

  ArmParameters<double> arm_;  // with the effects' changes
  Eigen::VectorXd home_, motor_angle_;
  double time_ = 0;
  Estimate estimate_;
  EstimatorReport report_;
};

}  // namespace halyard

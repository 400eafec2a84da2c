#pragma once
/// Kinematics without elasticity, as the arm's own software computes it. Joint positions come from motor angles by the
/// inverse of Eq. 8, q = R⁻¹ (r_m / N) q_m (coupling.h); velocities are differences of successive samples.

#include "estimators/estimator.h"
#include "model/arm_model.h"
#include "transmission/coupling.h"

namespace halyard {

/// A motor whose sample is missing keeps its last angle, or its home angle if it has none yet. A joint without motor is
/// assumed to be at home. There is no correction: innovations are empty.
class KinematicsEstimator final : public Estimator {
 public:
  explicit KinematicsEstimator(const ArmModel& model);

  void reset(const Sample& first) override;
  /// Throws std::invalid_argument if time does not increase.
  Innovation update(const Sample& sample) override;
  Estimate estimate() const override { return estimate_; }
  EstimatorReport report() const override { return report_; }

 private:
  /// Sets position_ from the sample's angles.
  void read(const Sample& sample);

  ArmParameters<double> arm_;  // with the effects' changes
  UnstretchedJoints joints_;
  Eigen::VectorXd home_, motor_angle_, position_;
  double time_ = 0;
  Estimate estimate_;
  EstimatorReport report_;
};

}  // namespace halyard

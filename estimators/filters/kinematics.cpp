#include "estimators/filters/kinematics.h"

#include <cmath>
#include <stdexcept>

#include "model/output/number_text.h"

namespace halyard {

KinematicsEstimator::KinematicsEstimator(const ArmModel& model)
    : arm_(arm_with_effects(model)), joints_(arm_), home_(model.home()) {}

void KinematicsEstimator::read(const Sample& sample) {
  for (int k = 0; k < arm_.n; ++k)
    if (std::isfinite(sample.motor_position(k)))
      motor_angle_(k) = sample.motor_position(k) - arm_.joint[k].motor_encoder_offset;
  joints_.solve(motor_angle_, home_, position_);
}

void KinematicsEstimator::reset(const Sample& first) {
  motor_angle_ = unstretched_motors(arm_, home_);
  read(first);
  estimate_.joint_position = position_;
  estimate_.joint_velocity = estimate_.joint_position_std = Eigen::VectorXd::Zero(arm_.n);
  time_ = first.time_s;
  report_ = {};
}

Innovation KinematicsEstimator::update(const Sample& sample) {
  const double dt = sample.time_s - time_;
  if (!(dt > 0))
    throw std::invalid_argument("kinematics: time does not increase at " + with_digits(sample.time_s, 12) + " s");
  read(sample);
  estimate_.joint_velocity = (position_ - estimate_.joint_position) / dt;
  estimate_.joint_position = position_;
  time_ = sample.time_s;
  ++report_.steps;
  Innovation innovation;
  innovation.time_s = sample.time_s;
  return innovation;
}

}  // namespace halyard

#pragma once
/// Base class for observers with a gain of their own choice, without covariance. The author writes prediction and
/// correction; the base class handles time, missing samples and counting.
///
///   x⁻ = predict(dt, τ)      ν = z - predicted_motor_position()      x = correct(ν)
///
///   τ   motor torque of the previous sample; held where missing, 0 before the first   [n]  N m
///   z   measured motor position                                                       [n]  rad
///   ν   0 where z is missing                                                          [n]  rad
///
/// Without cov(ν) there is no test of ν, so update() returns an empty innovation.

#include <Eigen/Core>
#include <cmath>

#include "estimators/estimator.h"
#include "model/arm_model.h"
#include "transmission/coupling.h"

namespace halyard {

class Observer : public Estimator {
 public:
  void reset(const Sample& first) final {
    torque_ = Eigen::VectorXd::Zero(home_.size());
    hold(first.motor_torque);
    time_s_ = first.time_s;
    steps_ = 0;
    start(first.motor_position.array().isNaN().select(home_, first.motor_position));
  }

  Innovation update(const Sample& sample) final {
    predict(sample.time_s - time_s_, torque_);
    const Eigen::VectorXd nu = sample.motor_position - predicted_motor_position();
    correct(sample.motor_position.array().isNaN().select(0, nu));
    hold(sample.motor_torque);
    time_s_ = sample.time_s;
    ++steps_;
    Innovation none;
    none.time_s = sample.time_s;
    return none;
  }

  EstimatorReport report() const final { return {steps_, 0, 0}; }

 protected:
  explicit Observer(const ArmModel& model)
      : arm_(arm_with_effects(model)), home_(unstretched_motors(arm_, model.home())) {
    for (int k = 0; k < arm_.n; ++k) home_(k) += arm_.joint[k].motor_encoder_offset;
  }

  /// The arm's parameters, with the changes that the model's effects make to them.
  const ArmParameters<double>& arm() const { return arm_; }

  /// Starts at rest at these readings of the motor encoders [n], rad. A missing reading is replaced by the reading at
  /// the home position.
  virtual void start(const Eigen::VectorXd& motor_position) = 0;
  /// Advances the state by dt_s > 0 under constant torque [n], N m.
  virtual void predict(double dt_s, const Eigen::VectorXd& motor_torque) = 0;
  /// Predicted readings of the motor encoders, ẑ, [n], rad.
  virtual Eigen::VectorXd predicted_motor_position() const = 0;
  virtual void correct(const Eigen::VectorXd& nu) = 0;

 private:
  void hold(const Eigen::VectorXd& motor_torque) {
    torque_ = motor_torque.array().isNaN().select(torque_, motor_torque);
  }

  ArmParameters<double> arm_;
  Eigen::VectorXd home_;  // motor encoder readings at home, rad
  Eigen::VectorXd torque_;
  double time_s_ = 0;
  long steps_ = 0;
};

}  // namespace halyard

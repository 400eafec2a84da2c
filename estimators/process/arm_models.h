#pragma once
/// Adapts an arm's process model to the interfaces of gaussian_filter.h: one step, and the motors' readings.

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "estimators/filters/gaussian_filter.h"
#include "estimators/process/process_model.h"

namespace halyard {

/// f over one step. The process model must outlive this object.
class ArmProcess : public DiscreteProcess {
 public:
  ArmProcess(const ProcessModel& model, const Step& step) : model_(model), step_(step) {}
  void advance(Eigen::MatrixXd& X) const override { model_.advance_many(step_, X); }
  void advance_with_jacobian(Eigen::VectorXd& x, Eigen::MatrixXd& F) const override {
    model_.advance_with_jacobian(step_, x.data(), F);
  }
  std::string name_of(int state) const override {
    std::ostringstream text;
    text << model_.state_name(state) << " at " << step_.time_s + step_.dt_s << " s";
    return text.str();
  }

 protected:
  const ProcessModel& model_;
  Step step_;
};

/// h for some of the motors, given by the 0-based indices of their joints. The process model must outlive this object.
class MotorReadings final : public MeasurementModel {
 public:
  MotorReadings(const ProcessModel& model, double time_s, std::vector<int> motors)
      : model_(model), time_(time_s), motors_(std::move(motors)) {}
  bool is_affine() const override { return model_.readings_are_linear(); }
  Eigen::VectorXd read(const Eigen::VectorXd& x) const override { return model_.motor_readings(time_, x)(motors_); }
  Eigen::VectorXd linearise(const Eigen::VectorXd& x, Eigen::MatrixXd& H) const override {
    Eigen::MatrixXd all;
    const Eigen::VectorXd z = model_.motor_readings(time_, x, &all);
    H = all(motors_, Eigen::all);
    return z(motors_);
  }

 private:
  const ProcessModel& model_;
  double time_;
  std::vector<int> motors_;
};

}  // namespace halyard

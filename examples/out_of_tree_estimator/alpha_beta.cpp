// An estimator of your own: an α-β filter on each motor, joints by kinematics. What it shows: a plug-in is one class,
// and one function that exports it. Look for the velocity, which plain kinematics gets from differences of encoder
// counts.
//
//   predict   x⁻ = x + dt v,  v⁻ = v
//   correct   x = x⁻ + α ν,   v = v⁻ + β ν / dt      ν: measured motor angle less x⁻
//
// α = 1 - θ², β = (1 - θ)², θ = exp(-2π f dt): critically damped with the bandwidth f, option `bandwidth_Hz`.
// Source: Brookner, "Tracking and Kalman Filtering Made Easy", 1998, section 1.3.
#include <cmath>
#include <numbers>

#include "estimators/estimator_options.h"
#include "plugins/estimator_plugin.hpp"
#include "plugins/observer.h"

namespace {

using Eigen::VectorXd;

class AlphaBeta : public halyard::Observer {
 public:
  AlphaBeta(const halyard::ArmModel& model, const halyard::EstimatorOptions& options)
      : Observer(model), home_(model.home()) {
    halyard::OptionReader reader("alpha_beta", options);
    bandwidth_ = 2 * std::numbers::pi * reader.number("bandwidth_Hz", 20, 0.01, 1e4);
    reader.finish();
  }

  halyard::Estimate estimate() const override {
    VectorXd angle = x_;
    for (int k = 0; k < arm().n; ++k) angle(k) -= arm().joint[k].motor_encoder_offset;
    const VectorXd zero = VectorXd::Zero(arm().n);
    return {unstretched_joints(arm(), angle, home_), unstretched_joints(arm(), v_, zero), zero};
  }

 private:
  void start(const VectorXd& motor_position) override {
    x_ = motor_position;
    v_ = VectorXd::Zero(x_.size());
  }
  void predict(double dt_s, const VectorXd& /*motor_torque*/) override {
    x_ += dt_s * v_;
    dt_ = dt_s;
  }
  VectorXd predicted_motor_position() const override { return x_; }
  void correct(const VectorXd& nu) override {
    const double theta = std::exp(-bandwidth_ * dt_);
    x_ += (1 - theta * theta) * nu;
    v_ += (1 - theta) * (1 - theta) / dt_ * nu;
  }

  VectorXd home_, x_, v_;
  double bandwidth_ = 0, dt_ = 0;
};

}  // namespace

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<AlphaBeta>("alpha_beta", "critically damped alpha-beta filter");
  return &table;
}

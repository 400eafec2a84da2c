#pragma once
/// PD control of motor positions at a fixed period, zero-order hold.
///
///   e = q_m,d - q_m,   τ = kp e + kd (e - e_before) / Δt,   |τ| <= limit
///
///   q_m,d, q_m   desired motor angle, encoder reading     rad
///   e_before     e one period ago; e itself at the start   rad

#include <Eigen/Core>
#include <vector>

#include "model/arm_model.h"

namespace halyard {

class PdController {
 public:
  /// parameters: one set for each joint.
  PdController(std::vector<ControllerParameters> parameters, double period_s);

  /// Torque commands for desired and measured motor angles, [n] each.
  Eigen::VectorXd torque(const Eigen::VectorXd& desired, const Eigen::VectorXd& measured);

 private:
  std::vector<ControllerParameters> parameters_;
  double period_;
  Eigen::VectorXd error_before_;
};

}  // namespace halyard

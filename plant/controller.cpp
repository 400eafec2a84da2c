#include "plant/controller.h"

#include <algorithm>
#include <utility>

namespace halyard {

PdController::PdController(std::vector<ControllerParameters> parameters, double period_s)
    : parameters_(std::move(parameters)), period_(period_s) {}

Eigen::VectorXd PdController::torque(const Eigen::VectorXd& desired, const Eigen::VectorXd& measured) {
  const Eigen::VectorXd error = desired - measured;
  if (error_before_.size() == 0) error_before_ = error;
  Eigen::VectorXd torque(error.size());
  for (int k = 0; k < torque.size(); ++k) {
    const ControllerParameters& p = parameters_[k];
    torque(k) = p.kp * error(k) + p.kd * (error(k) - error_before_(k)) / period_;
    if (p.torque_limit > 0) torque(k) = std::clamp(torque(k), -p.torque_limit, p.torque_limit);
  }
  error_before_ = error;
  return torque;
}

}  // namespace halyard

#include "transmission/coupling.h"

#include <Eigen/LU>
#include <stdexcept>

namespace halyard {

Eigen::MatrixXd path_matrix(const ArmParameters<double>& arm) {
  Eigen::MatrixXd R(arm.n, arm.n);
  for (int i = 0; i < arm.n; ++i)
    for (int j = 0; j < arm.n; ++j) R(i, j) = path_per_joint(arm.joint[i], j);
  return R;
}

Eigen::VectorXd unstretched_joints(const ArmParameters<double>& arm, const Eigen::VectorXd& q_m,
                                   const Eigen::VectorXd& q_undriven) {
  Eigen::MatrixXd R = path_matrix(arm);
  Eigen::VectorXd s(arm.n);
  for (int i = 0; i < arm.n; ++i) {
    if (arm.joint[i].drive == Drive::none) {
      R.row(i).setZero();
      R(i, i) = 1;
      s(i) = q_undriven(i);
    } else {
      s(i) = arm.joint[i].motor_travel() * q_m(i);
    }
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(R);
  if (!lu.isInvertible())
    throw std::invalid_argument("coupling matrix [" + std::to_string(arm.n) + " x " + std::to_string(arm.n) +
                                "] has rank " + std::to_string(lu.rank()) +
                                ": some joint direction moves no motor; correct the coupling coefficients");
  return lu.solve(s);
}

Eigen::VectorXd unstretched_motors(const ArmParameters<double>& arm, const Eigen::VectorXd& q) {
  Eigen::VectorXd q_m = path_matrix(arm) * q;
  for (int i = 0; i < arm.n; ++i)
    q_m(i) = arm.joint[i].drive == Drive::none ? 0.0 : q_m(i) / arm.joint[i].motor_travel();
  return q_m;
}

}  // namespace halyard

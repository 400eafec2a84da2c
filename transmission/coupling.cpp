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

UnstretchedJoints::UnstretchedJoints(const ArmParameters<double>& arm) {
  Eigen::MatrixXd R = path_matrix(arm);
  Eigen::VectorXd travel(arm.n), own(arm.n);
  for (int i = 0; i < arm.n; ++i) {
    const bool driven = arm.joint[i].drive != Drive::none;
    if (!driven) R.row(i) = Eigen::RowVectorXd::Unit(arm.n, i);
    travel(i) = driven ? arm.joint[i].motor_travel() : 0;
    own(i) = driven ? 0 : 1;
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(R);
  if (!lu.isInvertible())
    throw std::invalid_argument("coupling matrix [" + std::to_string(arm.n) + " x " + std::to_string(arm.n) +
                                "] has rank " + std::to_string(lu.rank()) +
                                ": some joint direction moves no motor; correct the coupling coefficients");
  per_motor_ = lu.solve(Eigen::MatrixXd(travel.asDiagonal()));
  per_undriven_ = lu.solve(Eigen::MatrixXd(own.asDiagonal()));
}

void UnstretchedJoints::solve(const Eigen::VectorXd& q_m, const Eigen::VectorXd& q_undriven, Eigen::VectorXd& q) const {
  q.noalias() = per_motor_ * q_m;
  q.noalias() += per_undriven_ * q_undriven;
}

Eigen::VectorXd unstretched_joints(const ArmParameters<double>& arm, const Eigen::VectorXd& q_m,
                                   const Eigen::VectorXd& q_undriven) {
  Eigen::VectorXd q;
  UnstretchedJoints(arm).solve(q_m, q_undriven, q);
  return q;
}

Eigen::VectorXd unstretched_motors(const ArmParameters<double>& arm, const Eigen::VectorXd& q) {
  Eigen::VectorXd q_m = path_matrix(arm) * q;
  for (int i = 0; i < arm.n; ++i)
    q_m(i) = arm.joint[i].drive == Drive::none ? 0.0 : q_m(i) / arm.joint[i].motor_travel();
  return q_m;
}

}  // namespace halyard

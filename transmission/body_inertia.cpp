#include "transmission/body_inertia.h"

#include <Eigen/Eigenvalues>

namespace halyard {

Eigen::Vector3d principal_moments(const JointParameters<double>& joint) {
  const double* I = joint.inertia;
  Eigen::Matrix3d tensor;
  tensor << I[0], I[3], I[4], I[3], I[1], I[5], I[4], I[5], I[2];
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly).eigenvalues();
}

InertiaFault find_inertia_fault(const Eigen::Vector3d& moments) {
  const double rounding = 1e-9 * moments.cwiseAbs().maxCoeff();
  if (moments(0) < -rounding) return InertiaFault::negative_moment;
  return moments(2) > moments(0) + moments(1) + rounding ? InertiaFault::triangle_inequality : InertiaFault::none;
}

}  // namespace halyard

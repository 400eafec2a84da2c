#include "estimators/eigen_modes.h"

#include <Eigen/Eigenvalues>

namespace halyard {

EigenModes eigen_modes(const Eigen::MatrixXd& A) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A) {
  constexpr bool kWithVectors = false;
  return Eigen::EigenSolver<Eigen::MatrixXd>(A, kWithVectors).eigenvalues();
}

}  // namespace halyard

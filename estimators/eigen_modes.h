#pragma once
/// Eigenvalues of a real matrix that need not be symmetric: A v = λ v, A [n x n], λ [n] complex, unordered.
/// Eigen's solver takes 14 s to compile. So only one source file includes it, and all other code calls these functions.

#include <Eigen/Core>

namespace halyard {

/// λ and V [n x n], whose columns are the right eigenvectors, of unit length.
struct EigenModes {
  Eigen::VectorXcd eigenvalues;
  Eigen::MatrixXcd eigenvectors;
};

EigenModes eigen_modes(const Eigen::MatrixXd& A);

/// λ alone, in less time.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

}  // namespace halyard

#pragma once
/// Least squares with a prior u ~ N(0, I), summed up by blocks b of a record, and intervals by leaving out one block
/// each:
///
///   A = Σ A_b + I,   step = A⁻¹ (Σ g_b - u),   var(u) = max( (B-1)/B Σ_b (u_-b - mean)² + |rows of A⁻¹|²,  diag A⁻¹ )
///
///   u          numbers, in deviations of their prior                       [p]
///   A_b, g_b   Σ Yᵀ S⁻¹ Y and Σ Yᵀ S⁻¹ ν of the block's samples at u        [p x p], [p]
///   B          number of blocks; u_-b is the estimate without block b
///
/// identify.h says why. Source: Künsch, Annals of Statistics 17 (1989).

#include <Eigen/Core>
#include <vector>

namespace halyard {

/// The sums of one block.
struct BlockSums {
  Eigen::MatrixXd A;
  Eigen::VectorXd g;
};

struct JackknifeEstimate {
  Eigen::VectorXd u;
  Eigen::VectorXd deviation;  ///< of u; 0 of a number that lies at its bound
  int blocks = 0;
};

/// Steps from `u` to the least squares under |u| <= bound, with the jackknife around its end.
JackknifeEstimate jackknife_least_squares(const std::vector<BlockSums>& blocks, const Eigen::VectorXd& u,
                                          const Eigen::VectorXd& bound);

}  // namespace halyard

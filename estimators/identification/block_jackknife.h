#pragma once
/// Least squares over the blocks b of a record, with the prior u ~ N(0, I). The variance comes from estimates that
/// leave out one block each:
///
///   A = Σ A_b + I,   step = A⁻¹ (Σ g_b - u),   var(u) = max( (B-1)/B Σ_b (u_-b - mean)² + |rows of A⁻¹|²,  diag A⁻¹ )
///
///   u          parameters, in standard deviations of their prior           [p]
///   A_b, g_b   Σ Yᵀ S⁻¹ Y / s² and Σ Yᵀ S⁻¹ ν / s² over the samples of block b, evaluated at u; Y, S and ν as in
///              DualStep (dual_ukf.h), s² as in identify.h                  [p x p], [p]
///   B          number of blocks, at least one; u_-b is the estimate without block b
///
/// The reasons are in identify.h. Source: Künsch, Annals of Statistics 17 (1989).

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
  Eigen::VectorXd deviation;  ///< standard deviation of u; 0 for a parameter at its bound
  int blocks = 0;             ///< B
};

/// Solves the least-squares problem, linearised at `u`, under |u| <= bound. Also computes the jackknife variance of the
/// solution.
JackknifeEstimate jackknife_least_squares(const std::vector<BlockSums>& blocks, const Eigen::VectorXd& u,
                                          const Eigen::VectorXd& bound);

}  // namespace halyard

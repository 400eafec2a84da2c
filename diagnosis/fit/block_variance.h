#pragma once
/// Covariance of least-squares estimates whose residuals are correlated over time: the infinitesimal jackknife over
/// blocks of rows.
///
///   C = H⁻¹ (B / (B - 1) Σ_b g_b g_bᵀ + P) H⁻¹,   H = Jᵀ J + P,   g_b = J_bᵀ r_b
///
///   r, J   weighted residuals and their sensitivities at the minimum                     [rows], [rows x p]
///   P      information of the prior                                                      [p x p]
///   B      blocks; each is several correlation times of the residual long
///
/// It holds whatever the scale and the correlation of the residuals are, as long as blocks are nearly independent.
/// Source: Jaeckel, The infinitesimal jackknife, Bell Labs (1972); Cameron, Miller, J. Human Resources 50 (2015),
/// eq. 11.

#include <Eigen/Core>
#include <span>

namespace halyard {

struct BlockVariance {
  Eigen::MatrixXd covariance;  ///< C, [p x p]
  int blocks = 0;              ///< B
};

/// block: of each row, ascending within a channel. prior: diagonal of P.
BlockVariance block_variance(const Eigen::MatrixXd& J, const Eigen::VectorXd& r, const Eigen::VectorXd& prior,
                             std::span<const int> block);

/// Correlation time of the residuals of consecutive rows, in rows, at least 1: τ = 1 + 2 Σ_l ρ_l, summed over the lags
/// l before ρ_l falls below 0.1.
double correlation_rows(std::span<const double> residual);

/// Groups consecutive blocks. Each group is at least `blocks_long` blocks long, unless fewer than `fewest` groups would
/// be left. Returns the group of each row.
std::vector<int> grouped_blocks(std::span<const int> block, double blocks_long, int fewest);

}  // namespace halyard

#pragma once
/// The part of a residual that the model's numbers cannot explain, to first order: what a fit with their linear columns
/// would leave. Effects that resemble a change of a number are compared by it.
///
///   r⊥ = r - J (Jᵀ J + P)⁻¹ Jᵀ r        left = |r⊥|² plus the prior cost of the numbers
///
///   r   rows of the fitting blocks, each channel over its scale and the root of its correlated rows    [rows]
///   J   sensitivities to the numbers, P their prior, centred where the columns were computed          [rows x numbers]
///
/// The numbers may take any value, which makes r⊥ a projection, cheap for many candidates. Where their tolerances have
/// to bound them, as in a plan of what a motion will reveal, see baseline_reach.h.
///
/// Source: variable projection, Golub and Pereyra, SIAM J. Numer. Anal. 10 (1973) 413-432.

#include <Eigen/Core>

#include "diagnosis/fit/fit.h"

namespace halyard {

class BeyondNumbers {
 public:
  /// columns: sensitivities(), one for each number.
  BeyondNumbers(const Evidence& evidence, const std::vector<std::vector<double>>& columns,
                const std::vector<double>& scale);

  /// r of such rows.
  Eigen::VectorXd weighted(const std::vector<double>& rows) const;
  /// [rows + numbers]: r⊥, then the numbers' share of the prior cost.
  Eigen::VectorXd of(const Eigen::VectorXd& r) const;
  /// Infinite for empty rows.
  double left(const std::vector<double>& rows) const;

 private:
  Eigen::VectorXd scale_;  ///< row_scale(), [rows]
  Eigen::MatrixXd Q_;      ///< an orthonormal basis of what the numbers explain, [rows + numbers x numbers]
};

}  // namespace halyard

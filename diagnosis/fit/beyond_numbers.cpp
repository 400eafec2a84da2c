#include "diagnosis/fit/beyond_numbers.h"

#include <Eigen/QR>
#include <cmath>
#include <limits>

namespace halyard {

BeyondNumbers::BeyondNumbers(const Evidence& evidence, const std::vector<std::vector<double>>& columns,
                             const std::vector<double>& scale)
    : evidence_(evidence), scale_(scale) {
  const auto rows = static_cast<Eigen::Index>(evidence.row_channel().size());
  const auto numbers = static_cast<Eigen::Index>(columns.size());
  // The prior is a row more for each number: with it the projection is that of the penalised fit.
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows + numbers, numbers);
  for (Eigen::Index i = 0; i < numbers; ++i) {
    J.col(i).head(rows) = weighted(columns[static_cast<std::size_t>(i)]);
    J(rows + i, i) = 1;
  }
  Q_ = J.householderQr().householderQ() * Eigen::MatrixXd::Identity(rows + numbers, numbers);
}

Eigen::VectorXd BeyondNumbers::weighted(const std::vector<double>& rows) const {
  Eigen::VectorXd r(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    r(static_cast<Eigen::Index>(i)) =
        rows[i] / (scale_[evidence_.row_channel()[i]] * std::sqrt(evidence_.correlated_rows()));
  return r;
}

Eigen::VectorXd BeyondNumbers::of(const Eigen::VectorXd& r) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(Q_.rows());
  x.head(r.size()) = r;
  const Eigen::VectorXd explained = Q_.topRows(r.size()).transpose() * r;
  x.noalias() -= Q_ * explained;
  return x;
}

double BeyondNumbers::left(const std::vector<double>& rows) const {
  if (rows.empty()) return std::numeric_limits<double>::infinity();
  return of(weighted(rows)).squaredNorm();
}

}  // namespace halyard

#include "diagnosis/fit/beyond_numbers.h"

#include <Eigen/QR>
#include <limits>

namespace halyard {

BeyondNumbers::BeyondNumbers(const Evidence& evidence, const std::vector<std::vector<double>>& columns,
                             const std::vector<double>& scale)
    : scale_(row_scale(evidence, scale)) {
  const Eigen::Index rows = scale_.size();
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
  return Eigen::Map<const Eigen::VectorXd>(rows.data(), scale_.size()).cwiseQuotient(scale_);
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

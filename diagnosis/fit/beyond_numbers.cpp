#include "diagnosis/fit/beyond_numbers.h"

#include <cmath>
#include <limits>

namespace halyard {

BeyondNumbers::BeyondNumbers(const Evidence& evidence, const std::vector<std::vector<double>>& columns,
                             const std::vector<double>& scale)
    : evidence_(evidence), scale_(scale), numbers_(static_cast<Eigen::Index>(columns.size())) {
  const auto rows = static_cast<Eigen::Index>(evidence.row_channel().size());
  // The prior is a row more for each number: with it the projection is that of the penalised fit.
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows + numbers_, numbers_);
  for (Eigen::Index i = 0; i < numbers_; ++i) {
    J.col(i).head(rows) = weighted(columns[static_cast<std::size_t>(i)]);
    J(rows + i, i) = 1;
  }
  qr_.compute(J);
}

Eigen::VectorXd BeyondNumbers::weighted(const std::vector<double>& rows) const {
  Eigen::VectorXd r(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    r(static_cast<Eigen::Index>(i)) =
        rows[i] / (scale_[evidence_.row_channel()[i]] * std::sqrt(evidence_.correlated_rows()));
  return r;
}

/// In the basis of the QR factorisation, without what the numbers explain.
Eigen::VectorXd BeyondNumbers::rotated(const Eigen::VectorXd& r) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(r.size() + numbers_);
  x.head(r.size()) = r;
  x = qr_.householderQ().adjoint() * x;
  x.head(numbers_).setZero();
  return x;
}

Eigen::VectorXd BeyondNumbers::of(const Eigen::VectorXd& r) const { return qr_.householderQ() * rotated(r); }

double BeyondNumbers::left(const std::vector<double>& rows) const {
  if (rows.empty()) return std::numeric_limits<double>::infinity();
  return rotated(weighted(rows)).squaredNorm();
}

}  // namespace halyard

#include "diagnosis/search/screen.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/search/leaps.h"

namespace halyard {

Screen::Screen(const Evidence& evidence, const Hypothesis& at, const std::vector<std::vector<double>>& columns,
               const std::vector<double>& scale)
    : evidence_(evidence), scale_(scale), numbers_(static_cast<int>(columns.size())) {
  const auto rows = static_cast<Eigen::Index>(evidence.row_channel().size());
  // The prior is a row more for each number: with it the projection is that of the penalised fit.
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows + numbers_, numbers_);
  for (int i = 0; i < numbers_; ++i) {
    J.col(i).head(rows) = weighted(columns[i]);
    J(rows + i, i) = 1;
  }
  qr_.compute(J);
  const std::vector<double> residual = evidence.fit_rows({at})[0];
  instants_ = leaps(evidence, residual);
  r_ = weighted(residual);
  r_beyond_ = beyond_baseline(r_);
}

Eigen::VectorXd Screen::weighted(const std::vector<double>& rows) const {
  Eigen::VectorXd x(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t r = 0; r < rows.size(); ++r)
    x(static_cast<Eigen::Index>(r)) =
        rows[r] / (scale_[evidence_.row_channel()[r]] * std::sqrt(evidence_.correlated_rows()));
  return x;
}

Eigen::VectorXd Screen::beyond_baseline(Eigen::VectorXd x) const {
  const Eigen::Index rows = x.size();
  x.conservativeResize(rows + numbers_);
  x.tail(numbers_).setZero();
  x = qr_.householderQ().adjoint() * x;
  x.head(numbers_).setZero();
  return qr_.householderQ() * x;
}

Screen::Direction Screen::direction(const std::vector<double>& rows) const {
  if (rows.empty()) return {};
  const Eigen::VectorXd d = beyond_baseline(weighted(rows) - r_);
  const double along = r_beyond_.dot(d), square = d.squaredNorm(), size = square * r_beyond_.squaredNorm();
  return size > 0 ? Direction{along * along / size, -along / square} : Direction{};
}

double Screen::left(const std::vector<double>& rows) const {
  if (rows.empty()) return std::numeric_limits<double>::infinity();
  return beyond_baseline(weighted(rows)).squaredNorm();
}

}  // namespace halyard

#include "diagnosis/starts/screen.h"

#include "diagnosis/starts/leaps.h"

namespace halyard {

Screen::Screen(const Evidence& evidence, const Hypothesis& at, const std::vector<std::vector<double>>& columns,
               const std::vector<double>& scale)
    : beyond_(evidence, columns, scale) {
  const std::vector<double> residual = evidence.fit_rows({at})[0];
  instants_ = leaps(evidence, residual);
  r_ = beyond_.weighted(residual);
  r_beyond_ = beyond_.of(r_);
}

Screen::Direction Screen::direction(const std::vector<double>& rows) const {
  if (rows.empty()) return {};
  const Eigen::VectorXd d = beyond_.of(beyond_.weighted(rows) - r_);
  const double along = r_beyond_.dot(d), square = d.squaredNorm(), size = square * r_beyond_.squaredNorm();
  return size > 0 ? Direction{along * along / size, -along / square} : Direction{};
}

}  // namespace halyard

#include "diagnosis/fit/baseline_reach.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace halyard {
namespace {

constexpr double kWholeTolerance = 2;  ///< in units of a baseline number, see baseline_parameters()

}  // namespace

Eigen::VectorXd bounded_minimum(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& lower,
                                const Eigen::VectorXd& upper) {
  constexpr int kMostSteps = 100;
  constexpr double kSmall = 1e-9, kLeastStep = 1e-6;
  const auto within = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd { return u.cwiseMax(lower).cwiseMin(upper); };
  const auto cost = [&](const Eigen::VectorXd& u) { return 0.5 * u.dot(A * u) - b.dot(u); };
  Eigen::VectorXd u = within(A.ldlt().solve(b));
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::VectorXd g = A * u - b;
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0; i < u.size(); ++i)
      if (!(u(i) <= lower(i) && g(i) > 0) && !(u(i) >= upper(i) && g(i) < 0)) free.push_back(i);
    if (free.empty()) break;
    const Eigen::MatrixXd A_free = A(free, free);
    const Eigen::VectorXd g_free = g(free), newton = -A_free.ldlt().solve(g_free);
    // What a whole Newton step promises is what is still to be gained.
    if (-newton.dot(g_free) <= kSmall * std::max(1.0, std::abs(b.dot(u)))) break;
    const double before = cost(u);
    Eigen::VectorXd next = u;
    for (double length = 1; length > kLeastStep; length /= 2) {
      next = u;
      next(free) += length * newton;
      next = within(next);
      if (cost(next) < before) break;
    }
    if (!(cost(next) < before)) break;
    u = next;
  }
  return u;
}

BaselineReach::BaselineReach(const Evidence& evidence, const std::vector<std::vector<double>>& columns,
                             const std::vector<double>& scale) {
  weight_ = row_scale(evidence, scale).cwiseInverse();
  J_.resize(weight_.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) J_.col(static_cast<Eigen::Index>(i)) = weighted(columns[i]);
  A_ = J_.transpose() * J_;
  A_.diagonal().array() += 1;
}

Eigen::VectorXd BaselineReach::weighted(const std::vector<double>& rows) const {
  return weight_.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(rows.data(), weight_.size()));
}

std::vector<double> BaselineReach::rows(const Eigen::VectorXd& weighted) const {
  const Eigen::VectorXd all = weighted.cwiseQuotient(weight_);
  return {all.data(), all.data() + all.size()};
}

double BaselineReach::half_log_det() const {
  return Eigen::MatrixXd(A_.llt().matrixL()).diagonal().array().log().sum();
}

BaselineReach::Sizes BaselineReach::sizes(Eigen::MatrixXd E, Eigen::VectorXd lower, Eigen::VectorXd upper) const {
  Sizes s{std::move(E), std::move(lower), std::move(upper), {}, {}};
  s.JtE = J_.transpose() * s.E;
  s.EtE = s.E.transpose() * s.E;
  // Sizes may act alike; what they cannot share stays defined.
  s.EtE.diagonal() *= 1 + 1e-9;
  return s;
}

BaselineReach::Taken BaselineReach::take(const Eigen::VectorXd& x) const {
  return take(x, sizes(Eigen::MatrixXd(x.size(), 0), Eigen::VectorXd(0), Eigen::VectorXd(0)));
}

BaselineReach::Taken BaselineReach::take(const Eigen::VectorXd& x, const Sizes& sizes) const {
  const Eigen::Index p = J_.cols(), k = sizes.E.cols();
  Eigen::MatrixXd A(p + k, p + k);
  A.topLeftCorner(p, p) = A_;
  A.topRightCorner(p, k) = sizes.JtE;
  A.bottomLeftCorner(k, p) = sizes.JtE.transpose();
  A.bottomRightCorner(k, k) = sizes.EtE;
  Eigen::VectorXd b(p + k), lower = Eigen::VectorXd::Constant(p + k, -kWholeTolerance), upper = -lower;
  b.head(p) = J_.transpose() * x;
  b.tail(k) = sizes.E.transpose() * x;
  lower.tail(k) = sizes.lower;
  upper.tail(k) = sizes.upper;
  const Eigen::VectorXd u = bounded_minimum(A, b, lower, upper);
  Taken t;
  t.amount = u.tail(k);
  t.left = x - J_ * u.head(p) - sizes.E * t.amount;
  t.cost = t.left.squaredNorm() + u.head(p).squaredNorm();
  return t;
}

}  // namespace halyard

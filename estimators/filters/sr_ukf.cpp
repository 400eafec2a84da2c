#include "estimators/filters/sr_ukf.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace halyard {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kRoundings = 4;  // of one evaluation of f or h, relative to result and argument
constexpr double kNarrow = 0.1;   // largest γ of narrow sigma points

}  // namespace

SquareRootUkf::SquareRootUkf(const UkfWeights& weights) : weights_(weights) {
  if (!(weights.alpha > 0)) throw std::invalid_argument("unscented transform: alpha must be positive");
}

double SquareRootUkf::spread_squared() const {
  const double spread = weights_.alpha * weights_.alpha * (static_cast<double>(x_.size()) + weights_.kappa);
  if (!(spread > 0)) throw std::invalid_argument("unscented transform: number of states + kappa must be positive");
  return spread;
}

double SquareRootUkf::significant_shift(double shift, double size, double spread) const {
  const double rounding = kRoundings * kEps * static_cast<double>(x_.size()) / spread_squared() * size;
  const double curvature = std::abs(shift);
  return curvature > rounding && curvature <= weights_.curvature_limit * spread ? shift : 0;
}

void SquareRootUkf::place_sigma_points(Eigen::MatrixXd& X) const {
  const Eigen::Index n = x_.size();
  const double gamma = std::sqrt(spread_squared());
  X.resize(n, 2 * n + 1);
  X.col(0) = x_;
  X.middleCols(1, n) = (gamma * S_).colwise() + x_;
  // Opposite to what the first half was rounded to: a pair that is not symmetric would tell of a curvature.
  X.rightCols(n) = (-(X.middleCols(1, n).colwise() - x_)).colwise() + x_;
}

void SquareRootUkf::root_with_central(LaneMatrix& rows, const Eigen::Ref<const Eigen::VectorXd>& v,
                                      Eigen::Ref<Eigen::MatrixXd> L) {
  const double c = weights_.beta - weights_.alpha * weights_.alpha;
  rows.view().bottomRows(1) = std::sqrt(std::max(c, 0.0)) * v.transpose();
  root_.compute(rows, L);
  if (c >= 0) return;
  // A down-date, by the covariance itself; one that has lost its definiteness gets a floor.
  P_ = L.lazyProduct(L.transpose());
  P_.noalias() += c * v * v.transpose();
  llt_.compute(P_);
  if (llt_.info() == Eigen::Success) {
    L = llt_.matrixL();
    return;
  }
  ++repaired_;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(P_);
  const double floor = kEps * modes.eigenvalues().cwiseAbs().maxCoeff();
  rows.view().topRows(P_.rows()) =
      (modes.eigenvectors() * modes.eigenvalues().cwiseMax(floor).cwiseSqrt().asDiagonal()).transpose();
  rows.view().bottomRows(rows.rows() - P_.cols()).setZero();
  root_.compute(rows, L);
}

void SquareRootUkf::move_sigma_points(const DiscreteProcess& process) {
  const int n = static_cast<int>(x_.size());
  const double gamma = std::sqrt(spread_squared());
  X_.resize(n, 2 * n + 1);  // here, so that a later step needs no memory
  moved_in_pairs_ = gamma <= kNarrow && process.advance_pairs(x_, gamma, d_, delta_);
  if (moved_in_pairs_) {
    delta_ *= n / (gamma * gamma);
    return;
  }
  place_sigma_points(X_);
  process.advance(X_);
  x_ = X_.col(0);
  d_.reshape(2 * n, n);
  const double W = 0.5 / (gamma * gamma);
  d_.view() = (X_.rightCols(2 * n).colwise() - x_).transpose();
  for (int i = 0; i < n; ++i) delta_(i) = W * sum_of_rows(d_, i, 2 * n);
  d_.view() *= std::sqrt(W);
}

void SquareRootUkf::predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) {
  const int n = static_cast<int>(x_.size()), sources = static_cast<int>(Q_root.cols());
  size_ = x_.cwiseAbs();
  delta_.resize(n);
  move_sigma_points(process);
  const int points = d_.rows();
  squares_.resize(n);
  set_squares(d_, squares_.data());
  for (int i = 0; i < n; ++i)
    delta_(i) = significant_shift(delta_(i), std::max(size_(i), std::abs(x_(i))), std::sqrt(squares_(i)));
  x_ += delta_;
  predicted_columns_.reshape(points + sources + 1, n);
  for (int i = 0; i < n; ++i)
    std::copy_n(d_.lanes() + i * d_.blocks(), d_.blocks(),
                predicted_columns_.lanes() + i * predicted_columns_.blocks());
  set_rows_transposed(Q_root, predicted_columns_, points);
  root_with_central(predicted_columns_, delta_, S_);
  x_predicted_ = x_;
  check_finite(process);
}

void SquareRootUkf::set_columns_before(const Eigen::MatrixXd& S_0, Eigen::Ref<Eigen::MatrixXd> A_transposed) const {
  if (moved_in_pairs_) {
    A_transposed = S_0.transpose();
    return;
  }
  const double factor = std::sqrt(0.5);  // √W γ
  A_transposed.topRows(S_0.cols()) = factor * S_0.transpose();
  A_transposed.bottomRows(S_0.cols()) = -factor * S_0.transpose();
}

Innovation SquareRootUkf::update(const MeasurementModel& measurement, const ReadingVector& z,
                                 const ReadingMatrix& R_root, double gate) {
  if (measurement.is_affine()) return update_linear(measurement, z, R_root, gate);
  const int n = static_cast<int>(x_.size()), m = static_cast<int>(z.size()), points = 2 * n;
  const double W = 0.5 / spread_squared(), root_W = std::sqrt(W);
  place_sigma_points(X_);
  ReadingVector z_0(m), epsilon(m);
  measurement.read(X_.col(0), z_0);
  const ReadingVector size = z_0.cwiseAbs();
  e_.set_zero(points + m + 1, m);
  auto e = e_.view();
  ReadingVector reading(m);
  for (int i = 0; i < points; ++i) {
    measurement.read(X_.col(i + 1), reading);
    e.row(i) = (reading - z_0).transpose();
  }
  for (int i = 0; i < m; ++i)
    epsilon(i) =
        significant_shift(W * sum_of_rows(e_, i, points), size(i), std::sqrt(W * sum_of_squares(e_, i, points)));

  Innovation innovation;
  innovation.nu = z - z_0 - epsilon;
  check_measurement(innovation.nu);
  e.topRows(points) *= root_W;
  e.middleRows(points, m) = R_root.transpose();
  innovation.S_root.resize(m, m);
  root_with_central(e_, epsilon, innovation.S_root);
  const auto S_y = innovation.S_root.triangularView<Eigen::Lower>();
  ReadingVector whitened = innovation.nu;
  S_y.solveInPlace(whitened);
  innovation.accepted = whitened.squaredNorm() <= gate;
  if (!innovation.accepted) return innovation;

  rows_.set_zero(points + m + 1, n);
  auto rows = rows_.view();
  auto d = rows.topRows(points);
  d = root_W * (X_.rightCols(points).colwise() - x_).transpose();
  P_yx_.set_zero(m, n);
  auto K_transposed = P_yx_.view();
  K_transposed.noalias() = e.topRows(points).transpose() * d;
  S_y.solveInPlace(K_transposed);
  innovation.S_root.transpose().triangularView<Eigen::Upper>().solveInPlace(K_transposed);
  x_.noalias() += K_transposed.transpose() * innovation.nu;
  d.noalias() -= e.topRows(points) * K_transposed;
  rows.middleRows(points, m).noalias() = R_root.transpose() * K_transposed;
  delta_.noalias() = K_transposed.transpose() * epsilon;
  root_with_central(rows_, delta_, S_);
  return innovation;
}

}  // namespace halyard

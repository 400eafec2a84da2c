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
  X.middleCols(1, n) = (gamma * S()).colwise() + x_;
  // Opposite to what the first half was rounded to: a pair that is not symmetric would tell of a curvature.
  X.rightCols(n) = (-(X.middleCols(1, n).colwise() - x_)).colwise() + x_;
}

void SquareRootUkf::root_with_central(LaneMatrix& columns, const Eigen::Ref<const Eigen::VectorXd>& v,
                                      Eigen::Ref<Eigen::MatrixXd> L) {
  const double c = weights_.beta - weights_.alpha * weights_.alpha;
  columns.view().rightCols(1) = std::sqrt(std::max(c, 0.0)) * v;
  root_.compute(columns, L);
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
  repaired_columns_.reshape(static_cast<int>(P_.rows()), static_cast<int>(P_.cols()));
  repaired_columns_.view() = modes.eigenvectors() * modes.eigenvalues().cwiseMax(floor).cwiseSqrt().asDiagonal();
  root_.compute(repaired_columns_, L);
}

int SquareRootUkf::move_sigma_points(const DiscreteProcess& process, int others) {
  const int n = static_cast<int>(x_.size());
  const double gamma = std::sqrt(spread_squared());
  X_.resize(n, 2 * n + 1);  // here, so that a later step needs no memory
  predicted_columns_.reshape(n, n + others);
  moved_in_pairs_ = gamma <= kNarrow && process.advance_pairs(x_, S_, gamma, predicted_columns_, delta_);
  if (moved_in_pairs_) {
    delta_ *= n / (gamma * gamma);
    return n;
  }
  place_sigma_points(X_);
  process.advance(X_);
  x_ = X_.col(0);
  predicted_columns_.reshape(n, 2 * n + others);
  auto d = predicted_columns_.view().leftCols(2 * n);
  const double W = 0.5 / (gamma * gamma);
  d = X_.rightCols(2 * n).colwise() - x_;
  delta_ = W * (d.leftCols(n) + d.rightCols(n)).rowwise().sum();  // pair by pair: opposite numbers cancel
  d *= std::sqrt(W);
  return 2 * n;
}

void SquareRootUkf::predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) {
  const int n = static_cast<int>(x_.size()), sources = static_cast<int>(Q_root.cols());
  size_ = x_.cwiseAbs();
  delta_.resize(n);
  const int points = move_sigma_points(process, sources + 1);
  squares_.resize(n);
  set_row_squares(predicted_columns_, points, squares_.data());
  for (int i = 0; i < n; ++i)
    delta_(i) = significant_shift(delta_(i), std::max(size_(i), std::abs(x_(i))), std::sqrt(squares_(i)));
  x_ += delta_;
  set_block(Q_root, predicted_columns_.view().middleCols(points, sources));
  root_with_central(predicted_columns_, delta_, S_.view());
  x_predicted_ = x_;
  check_finite(process);
}

void SquareRootUkf::set_columns_before(const LaneMatrix::ConstView& S_0, Eigen::Ref<Eigen::MatrixXd> A) const {
  if (moved_in_pairs_) {
    A = S_0;
    return;
  }
  const double factor = std::sqrt(0.5);  // √W γ
  A.leftCols(S_0.cols()) = factor * S_0;
  A.rightCols(S_0.cols()) = -factor * S_0;
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
  e_.set_zero(m, points + m + 1);
  auto e = e_.view();
  ReadingVector reading(m), squares(m);
  for (int i = 0; i < points; ++i) {
    measurement.read(X_.col(i + 1), reading);
    e.col(i) = reading - z_0;
  }
  set_row_squares(e_, points, squares.data());
  for (int i = 0; i < m; ++i)
    epsilon(i) =
        significant_shift(W * (e.row(i).head(n) + e.row(i).segment(n, n)).sum(), size(i), std::sqrt(W * squares(i)));

  Innovation innovation;
  innovation.nu = z - z_0 - epsilon;
  check_measurement(innovation.nu);
  e.leftCols(points) *= root_W;
  e.middleCols(points, m) = R_root;
  innovation.S_root.resize(m, m);
  root_with_central(e_, epsilon, innovation.S_root);
  const auto S_y = innovation.S_root.triangularView<Eigen::Lower>();
  ReadingVector whitened = innovation.nu;
  S_y.solveInPlace(whitened);
  innovation.accepted = whitened.squaredNorm() <= gate;
  if (!innovation.accepted) return innovation;

  columns_.set_zero(n, points + m + 1);
  auto columns = columns_.view();
  auto d = columns.leftCols(points);
  d = root_W * (X_.rightCols(points).colwise() - x_);
  K_.set_zero(n, m);
  auto K = K_.view();
  K.noalias() = d * e.leftCols(points).transpose();
  innovation.S_root.transpose().triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(K);
  S_y.solveInPlace<Eigen::OnTheRight>(K);
  x_.noalias() += K * innovation.nu;
  d.noalias() -= K * e.leftCols(points);
  columns.middleCols(points, m).noalias() = K * R_root;
  delta_.noalias() = K * epsilon;
  root_with_central(columns_, delta_, S_.view());
  return innovation;
}

}  // namespace halyard

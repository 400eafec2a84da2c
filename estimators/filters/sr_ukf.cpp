#include "estimators/filters/sr_ukf.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace halyard {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kRoundings = 4;  // of one evaluation of f or h, relative to result and argument

/// `shift` becomes W Σ d_i over the columns of d, less what is rounding of numbers of that `size` or beyond the limit.
void set_mean_shift(const Eigen::Ref<const Eigen::MatrixXd>& d, const Eigen::Ref<const Eigen::VectorXd>& size, double W,
                    double curvature_limit, Eigen::Ref<Eigen::VectorXd> shift) {
  shift = W * d.rowwise().sum();
  const double rounding = kRoundings * kEps * W * static_cast<double>(d.cols());
  for (Eigen::Index i = 0; i < shift.size(); ++i) {
    const double curvature = std::abs(shift(i)), spread = std::sqrt(W * d.row(i).squaredNorm());
    if (!(curvature > rounding * size(i) && curvature <= curvature_limit * spread)) shift(i) = 0;
  }
}

}  // namespace

SquareRootUkf::SquareRootUkf(const UkfWeights& weights) : weights_(weights) {
  if (!(weights.alpha > 0)) throw std::invalid_argument("unscented transform: alpha must be positive");
}

double SquareRootUkf::spread_squared() const {
  const double spread = weights_.alpha * weights_.alpha * (static_cast<double>(x_.size()) + weights_.kappa);
  if (!(spread > 0)) throw std::invalid_argument("unscented transform: number of states + kappa must be positive");
  return spread;
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

void SquareRootUkf::root_with_central(Eigen::Ref<Eigen::MatrixXd> columns, const Eigen::Ref<const Eigen::VectorXd>& v,
                                      Eigen::Ref<Eigen::MatrixXd> L) {
  const double c = weights_.beta - weights_.alpha * weights_.alpha;
  columns.rightCols(1) = std::sqrt(std::max(c, 0.0)) * v;
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
  columns.leftCols(P_.rows()) = modes.eigenvectors() * modes.eigenvalues().cwiseMax(floor).cwiseSqrt().asDiagonal();
  columns.rightCols(columns.cols() - P_.cols()).setZero();
  root_.compute(columns, L);
}

void SquareRootUkf::predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) {
  const Eigen::Index n = x_.size(), points = 2 * n;
  place_sigma_points(X_);
  process.advance(X_);
  const double W = 0.5 / spread_squared();
  predicted_columns_.resize(n, points + Q_root.cols() + 1);
  auto d = predicted_columns_.leftCols(points);
  d = X_.rightCols(points).colwise() - X_.col(0);
  delta_.resize(n);
  size_ = x_.cwiseAbs().cwiseMax(X_.cwiseAbs().rowwise().maxCoeff());
  set_mean_shift(d, size_, W, weights_.curvature_limit, delta_);
  x_ = X_.col(0) + delta_;
  d *= std::sqrt(W);
  predicted_columns_.middleCols(points, Q_root.cols()) = Q_root;
  root_with_central(predicted_columns_, delta_, S_);
  x_predicted_ = x_;
  check_finite(process);
}

void SquareRootUkf::set_columns_before(const Eigen::MatrixXd& S_0, Eigen::Ref<Eigen::MatrixXd> A_transposed) const {
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
  e_.set_zero(m, points + m + 1);
  auto e = e_.view();
  for (int i = 0; i < points; ++i) {
    measurement.read(X_.col(i + 1), e.col(i));
    e.col(i) -= z_0;
  }
  set_mean_shift(e.leftCols(points), size, W, weights_.curvature_limit, epsilon);

  Innovation innovation;
  innovation.nu = z - z_0 - epsilon;
  check_measurement(innovation.nu);
  e.leftCols(points) *= root_W;
  e.middleCols(points, m) = R_root;
  innovation.S_root.resize(m, m);
  root_with_central(e, epsilon, innovation.S_root);
  const auto S_y = innovation.S_root.triangularView<Eigen::Lower>();
  ReadingVector whitened = innovation.nu;
  S_y.solveInPlace(whitened);
  innovation.accepted = whitened.squaredNorm() <= gate;
  if (!innovation.accepted) return innovation;

  columns_.set_zero(n, points + m + 1);
  auto columns = columns_.view();
  auto d = columns.leftCols(points);
  d = root_W * (X_.rightCols(points).colwise() - x_);
  P_yx_.set_zero(m, n);
  auto K_transposed = P_yx_.view();
  K_transposed.noalias() = e.leftCols(points) * d.transpose();
  S_y.solveInPlace(K_transposed);
  innovation.S_root.transpose().triangularView<Eigen::Upper>().solveInPlace(K_transposed);
  x_.noalias() += K_transposed.transpose() * innovation.nu;
  d.noalias() -= K_transposed.transpose() * e.leftCols(points);
  columns.middleCols(points, m).noalias() = K_transposed.transpose() * R_root;
  delta_.noalias() = K_transposed.transpose() * epsilon;
  root_with_central(columns, delta_, S_);
  return innovation;
}

}  // namespace halyard

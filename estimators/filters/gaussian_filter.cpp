#include "estimators/filters/gaussian_filter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace halyard {

namespace {

/// B [m x any] becomes L⁻¹ B, L lower triangular with few entries beside the diagonal.
template <class B_t>
void solve_lower(const ReadingMatrix& L, B_t&& B) {
  for (Eigen::Index i = 0; i < B.rows(); ++i) {
    for (Eigen::Index k = 0; k < i; ++k)
      for (Eigen::Index c = 0; L(i, k) != 0 && c < B.cols(); ++c) B(i, c) -= L(i, k) * B(k, c);
    const double per_diagonal = 1 / L(i, i);
    for (Eigen::Index c = 0; c < B.cols(); ++c) B(i, c) *= per_diagonal;
  }
}

/// C = A B of lower triangular factors [m x m].
void set_lower_product(const ReadingMatrix& A, const ReadingMatrix& B, ReadingMatrix& C) {
  const Eigen::Index m = A.rows();
  C.setZero(m, m);
  for (Eigen::Index c = 0; c < m; ++c)
    for (Eigen::Index r = c; r < m; ++r)
      for (Eigen::Index k = c; k <= r; ++k) C(r, c) += A(r, k) * B(k, c);
}

}  // namespace

void LowerRoot::finish(Eigen::Ref<Eigen::MatrixXd> L) {
  widest_matrix_kernels().lower_root(columns_.rows(), columns_.columns(), static_cast<int>(L.cols()), columns_.blocks(),
                                     columns_.lanes(), L.data(), static_cast<int>(L.outerStride()));
}

void GaussianFilter::reset(const Eigen::VectorXd& x, const Eigen::MatrixXd& S) {
  x_ = x;
  S_.reshape(static_cast<int>(S.rows()), static_cast<int>(S.cols()));
  set_block(S, S_.view());
}

Innovation GaussianFilter::update_linear(const MeasurementModel& measurement, const ReadingVector& z,
                                         const ReadingMatrix& R_root, double gate) {
  const int m = static_cast<int>(z.size()), n = static_cast<int>(x_.size());
  Innovation innovation;
  innovation.nu.resize(m);
  H_.reshape(m, n);
  auto H = H_.view();
  measurement.linearise(x_, innovation.nu, H);
  innovation.nu = z - innovation.nu;
  check_measurement(innovation.nu);
  solve_lower(R_root, H);
  corrected_ = S_;
  gain_.reshape(n, m);
  ReadingMatrix L(m, m);
  widest_matrix_kernels().correct(n, m, corrected_.blocks(), H.data(), static_cast<int>(H.outerStride()),
                                  corrected_.lanes(), gain_.lanes(), L.data(), static_cast<int>(L.outerStride()));
  set_lower_product(R_root, L, innovation.S_root);
  ReadingVector whitened = innovation.nu;
  solve_lower(innovation.S_root, whitened);
  innovation.accepted = whitened.squaredNorm() <= gate;
  if (innovation.accepted) {
    for (int j = 0; j < m; ++j) x_ += whitened(j) * gain_.view().col(j);
    std::swap(S_, corrected_);
  }
  return innovation;
}

void GaussianFilter::backward_step(const Eigen::VectorXd& x_0, const LaneMatrix& S_0, BackwardStep& step) {
  const int n = static_cast<int>(x_predicted_.size()), before = count_columns_before(),
            predicted = predicted_columns_.columns();
  auto array = array_root_.start(2 * n, predicted);
  set_block(std::as_const(predicted_columns_).view(), array.topRows(n));
  set_columns_before(S_0.view(), array.bottomLeftCorner(n, before));
  array.bottomRightCorner(n, predicted - before).setZero();
  triangle_.reshape(2 * n, n);
  auto triangle = triangle_.view();
  array_root_.finish(triangle);
  step.x_0 = x_0;
  step.x_predicted = x_predicted_;
  step.V_root.reshape(n, predicted - n);
  set_block(array_root_.rest().bottomRightCorner(n, predicted - n), step.V_root.view());
  step.G.reshape(n, n);
  set_block(triangle.bottomRows(n), step.G.view());
  auto S = triangle.topRows(n);
  for (int i = 0; i < n; ++i)
    if (!(S(i, i) > 0)) S(i, i) = 1;  // a state without doubt has no gain either
  S.triangularView<Eigen::Lower>().solveInPlace<Eigen::OnTheRight>(step.G.view());
}

void GaussianFilter::record(const DiscreteProcess& process, const Eigen::VectorXd& x_0,
                            LinearPrediction& prediction) const {
  prediction.x_0 = x_0;
  prediction.x_1 = x_predicted_;
  const int others = predicted_columns_.columns() - count_columns_before();
  prediction.N.reshape(predicted_columns_.rows(), others);
  set_block(std::as_const(predicted_columns_).view().rightCols(others), prediction.N.view());
  process.transition(x_0, prediction.F);
}

void GaussianFilter::predict_again(const LinearPrediction& p) {
  const int n = static_cast<int>(x_.size()), others = p.N.columns();
  deviation_ = x_ - p.x_0;
  x_ = p.x_1;
  x_.noalias() += p.F.view() * deviation_;
  again_.reshape(n, n + others);
  multiply(p.F.columns(0, n), right(S_), again_.columns(0, n), false);
  set_block(p.N.view(), again_.view().rightCols(others));
  root_.compute(again_, S_.view());
}

void GaussianFilter::check_finite(const DiscreteProcess& process) const {
  double squares[kMostRootRows];
  set_row_squares(S_, S_.columns(), squares);
  if (std::isfinite(x_.sum() + Eigen::Map<const Eigen::VectorXd>(squares, x_.size()).sum())) return;
  for (Eigen::Index i = 0; i < x_.size(); ++i)
    if (!std::isfinite(x_(i)) || !S().row(i).allFinite())
      throw std::runtime_error("filter: the belief of " + process.name_of(static_cast<int>(i)) +
                               " is not finite; check the noise options and the model's parameters");
}

void GaussianFilter::check_measurement(const ReadingVector& nu) {
  if (!nu.allFinite()) throw std::runtime_error("filter: a measurement is not finite; leave missing samples out");
}

}  // namespace halyard

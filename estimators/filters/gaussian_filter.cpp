#include "estimators/filters/gaussian_filter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace halyard {

void LowerRoot::finish(Eigen::Ref<Eigen::MatrixXd> L) {
  matrix_kernels()[0].lower_root(columns_.rows(), columns_.columns(), static_cast<int>(L.cols()), columns_.blocks(),
                                 columns_.lanes(), L.data(), static_cast<int>(L.outerStride()));
}

Innovation GaussianFilter::update_linear(const MeasurementModel& measurement, const ReadingVector& z,
                                         const ReadingMatrix& R_root, double gate) {
  const int m = static_cast<int>(z.size()), n = static_cast<int>(x_.size());
  Innovation innovation;
  innovation.nu.resize(m);
  H_.set_zero(m, n);
  measurement.linearise(x_, innovation.nu, H_.view());
  innovation.nu = z - innovation.nu;
  check_measurement(innovation.nu);
  auto array = array_root_.start(m + n, m + n);
  array.leftCols(m).setZero();
  array.topLeftCorner(m, m) = R_root;
  set_block(S_, array.bottomRightCorner(n, n));
  array.topRightCorner(m, n).setZero();
  const auto H = H_.view();
  for (int j = 0; j < m; ++j)
    for (int k = 0; k < n; ++k)
      if (const double h = H(j, k); h != 0) array.row(j).tail(n) += h * S_.row(k);
  gain_.reshape(m + n, m);
  const auto gain = gain_.view();
  array_root_.finish(gain);

  innovation.S_root = gain.topRows(m);
  ReadingVector whitened = innovation.nu;
  innovation.S_root.triangularView<Eigen::Lower>().solveInPlace(whitened);
  innovation.accepted = whitened.squaredNorm() <= gate;
  if (innovation.accepted) {
    for (int j = 0; j < m; ++j) x_ += whitened(j) * gain.col(j).tail(n);
    set_block(array_root_.rest().bottomRightCorner(n, n), S_);
  }
  return innovation;
}

void GaussianFilter::backward_step(const Eigen::VectorXd& x_0, const Eigen::MatrixXd& S_0, BackwardStep& step) {
  const int n = static_cast<int>(x_predicted_.size()), before = count_columns_before(),
            predicted = predicted_columns_.columns();
  auto array = array_root_.start(2 * n, std::max({predicted, before, 2 * n}));
  array.setZero();
  array.topLeftCorner(n, predicted) = predicted_columns_.view();
  set_columns_before(S_0, array.bottomLeftCorner(n, before));
  triangle_.reshape(2 * n, 2 * n);
  auto triangle = triangle_.view();
  array_root_.finish(triangle);
  step.x_0 = x_0;
  step.x_predicted = x_predicted_;
  step.V_root = triangle.bottomRightCorner(n, n);
  step.G = triangle.bottomLeftCorner(n, n);
  auto S = triangle.topLeftCorner(n, n);
  for (int i = 0; i < n; ++i)
    if (!(S(i, i) > 0)) S(i, i) = 1;  // a state without doubt has no gain either
  S.triangularView<Eigen::Lower>().solveInPlace<Eigen::OnTheRight>(step.G);
}

void GaussianFilter::record(const DiscreteProcess& process, const Eigen::VectorXd& x_0,
                            LinearPrediction& prediction) const {
  prediction.x_0 = x_0;
  prediction.x_1 = x_predicted_;
  const int others = predicted_columns_.columns() - count_columns_before();
  prediction.N.resize(predicted_columns_.rows(), others);
  set_block(std::as_const(predicted_columns_).view().rightCols(others), prediction.N);
  process.transition(x_0, prediction.F);
}

void GaussianFilter::predict_again(const LinearPrediction& p) {
  const int n = static_cast<int>(x_.size()), others = static_cast<int>(p.N.cols());
  F_.reshape(n, n);
  set_block(p.F, F_.view());
  deviation_ = x_ - p.x_0;
  x_ = p.x_1;
  x_.noalias() += p.F * deviation_;
  again_.reshape(n, n + others);
  multiply(F_.columns(0, n), right(S_), again_.columns(0, n), false);
  set_block(p.N, again_.view().rightCols(others));
  root_.compute(again_, S_);
}

void GaussianFilter::check_finite(const DiscreteProcess& process) const {
  if (std::isfinite(x_.sum() + S_.sum())) return;
  for (Eigen::Index i = 0; i < x_.size(); ++i)
    if (!std::isfinite(x_(i)) || !S_.row(i).allFinite())
      throw std::runtime_error("filter: the belief of " + process.name_of(static_cast<int>(i)) +
                               " is not finite; check the noise options and the model's parameters");
}

void GaussianFilter::check_measurement(const ReadingVector& nu) {
  if (!nu.allFinite()) throw std::runtime_error("filter: a measurement is not finite; leave missing samples out");
}

}  // namespace halyard

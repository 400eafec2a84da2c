#include "estimators/filters/gaussian_filter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace halyard {

void LowerRoot::compute(const Eigen::MatrixXd& A, Eigen::MatrixXd& L) {
  const int n = static_cast<int>(A.rows());
  columns_.set_zero(static_cast<int>(A.cols()), n);
  columns_.view() = A.transpose();
  L.setZero(n, n);
  matrix_kernels()[0].lower_root(n, columns_.blocks(), columns_.lanes(), L.data(), n);
}

Innovation GaussianFilter::update_linear(const MeasurementModel& measurement, const Eigen::VectorXd& z,
                                         const Eigen::MatrixXd& R_root, double gate) {
  measurement.linearise(x_, nu_, H_);
  nu_ = z - nu_;
  check_measurement(nu_);
  const Eigen::Index m = nu_.size(), n = x_.size();
  array_.setZero(m + n, m + n);
  array_.topLeftCorner(m, m) = R_root;
  array_.topRightCorner(m, n).noalias() = H_ * S_;
  array_.bottomRightCorner(n, n) = S_;
  array_root_.compute(array_, triangle_);

  Innovation innovation;
  innovation.nu = nu_;
  innovation.S_root = triangle_.topLeftCorner(m, m);
  whitened_ = nu_;
  innovation.S_root.triangularView<Eigen::Lower>().solveInPlace(whitened_);
  innovation.accepted = whitened_.squaredNorm() <= gate;
  if (innovation.accepted) {
    x_.noalias() += triangle_.bottomLeftCorner(n, m) * whitened_;
    S_ = triangle_.bottomRightCorner(n, n);
  }
  return innovation;
}

BackwardStep GaussianFilter::backward_step(const Eigen::VectorXd& x_0, const Eigen::MatrixXd& S_0) {
  const Eigen::Index n = x_predicted_.size();
  const Eigen::MatrixXd before = columns_before(S_0);
  array_.setZero(2 * n, std::max(predicted_columns_.cols(), 2 * n));
  array_.topLeftCorner(n, predicted_columns_.cols()) = predicted_columns_;
  array_.bottomLeftCorner(n, before.cols()) = before;
  array_root_.compute(array_, triangle_);
  BackwardStep step{x_0, x_predicted_, {}, triangle_.bottomRightCorner(n, n)};
  Eigen::MatrixXd S = triangle_.topLeftCorner(n, n);
  S.diagonal() = (S.diagonal().array() > 0).select(S.diagonal(), 1.0);  // a state without doubt has no gain either
  step.G = S.transpose().triangularView<Eigen::Upper>().solve(triangle_.bottomLeftCorner(n, n).transpose()).transpose();
  return step;
}

void GaussianFilter::check_finite(const DiscreteProcess& process) const {
  for (Eigen::Index i = 0; i < x_.size(); ++i)
    if (!std::isfinite(x_(i)) || !S_.row(i).allFinite())
      throw std::runtime_error("filter: the belief of " + process.name_of(static_cast<int>(i)) +
                               " is not finite; check the noise options and the model's parameters");
}

void GaussianFilter::check_measurement(const Eigen::VectorXd& nu) {
  if (!nu.allFinite()) throw std::runtime_error("filter: a measurement is not finite; leave missing samples out");
}

}  // namespace halyard

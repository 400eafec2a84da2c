#include "estimators/filters/ekf.h"

namespace halyard {

void ExtendedKalmanFilter::predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) {
  const Eigen::Index n = x_.size(), sources = Q_root.cols();
  predicted_columns_.reshape(static_cast<int>(n), static_cast<int>(n + sources));
  auto columns = predicted_columns_.view();
  F_.resize(n, n);  // here, so that a later step needs no memory
  if (!process.advance_root(x_, predicted_columns_)) {
    process.advance_with_jacobian(x_, F_);
    columns.leftCols(n) = F_.lazyProduct(S());
  }
  set_block(Q_root, columns.rightCols(sources));
  root_.compute(predicted_columns_, S_.view());
  x_predicted_ = x_;
  check_finite(process);
}

Innovation ExtendedKalmanFilter::update(const MeasurementModel& measurement, const ReadingVector& z,
                                        const ReadingMatrix& R_root, double gate) {
  return update_linear(measurement, z, R_root, gate);
}

}  // namespace halyard

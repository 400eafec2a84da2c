#include "estimators/filters/ekf.h"

namespace halyard {

void ExtendedKalmanFilter::predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) {
  const Eigen::Index n = x_.size(), sources = Q_root.cols();
  predicted_columns_.reshape(static_cast<int>(n + sources), static_cast<int>(n));
  auto columns = predicted_columns_.view();
  F_.resize(n, n);  // here, so that a later step needs no memory
  if (process.advance_root(x_, FS_)) {
    columns.topRows(n) = FS_.view();
  } else {
    process.advance_with_jacobian(x_, F_);
    columns.topRows(n) = F_.lazyProduct(S_).transpose();
  }
  set_rows_transposed(Q_root, predicted_columns_, static_cast<int>(n));
  root_.compute(predicted_columns_, S_);
  x_predicted_ = x_;
  check_finite(process);
}

Innovation ExtendedKalmanFilter::update(const MeasurementModel& measurement, const ReadingVector& z,
                                        const ReadingMatrix& R_root, double gate) {
  return update_linear(measurement, z, R_root, gate);
}

}  // namespace halyard

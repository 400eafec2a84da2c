#include "estimators/filters/ekf.h"

namespace halyard {

void ExtendedKalmanFilter::predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) {
  const Eigen::Index n = x_.size();
  F_.resize(n, n);
  process.advance_with_jacobian(x_, F_);
  predicted_columns_.resize(n, n + Q_root.cols());
  predicted_columns_.leftCols(n).noalias() = F_ * S_;
  predicted_columns_.rightCols(Q_root.cols()) = Q_root;
  root_.compute(predicted_columns_, S_);
  x_predicted_ = x_;
  check_finite(process);
}

Innovation ExtendedKalmanFilter::update(const MeasurementModel& measurement, const ReadingVector& z,
                                        const ReadingMatrix& R_root, double gate) {
  return update_linear(measurement, z, R_root, gate);
}

}  // namespace halyard

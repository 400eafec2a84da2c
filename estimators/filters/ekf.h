#pragma once
/// The extended Kalman filter in square-root form, with the Jacobian of the discrete step:
///
///   predict   x = f(x),  S = root of [F S, Q_root]              F = ∂f/∂x at the old x
///   update    GaussianFilter::update_linear()
///
/// Source: Jazwinski, "Stochastic Processes and Filtering Theory", 1970; Kailath, Sayed, Hassibi, chapter 12.

#include "estimators/filters/gaussian_filter.h"

namespace halyard {

class ExtendedKalmanFilter final : public GaussianFilter {
 public:
  void predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) override;
  Innovation update(const MeasurementModel& measurement, const ReadingVector& z, const ReadingMatrix& R_root,
                    double gate) override;

 private:
  int count_columns_before() const override { return static_cast<int>(x_.size()); }
  void set_columns_before(const LaneMatrix::ConstView& S_0, Eigen::Ref<Eigen::MatrixXd> A) const override { A = S_0; }

  Eigen::MatrixXd F_;
};

}  // namespace halyard

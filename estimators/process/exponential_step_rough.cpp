/// The parts of a step where f is not smooth: by the transmission at single states.

#include "estimators/process/exponential_step.h"

namespace halyard {

void ExponentialStep::set_end_slopes() {
  if (has_slopes_) return;
  process_.jacobian_beside(end_, x_2_, point_.chain, A_2_);
  slopes_ = step_.dt_s * (A_2_ - A_);
  has_slopes_ = true;
}

void ExponentialStep::set_rough_stage() {
  const double h = step_.dt_s;
  const int n = shape_.n, blocks = response_.blocks();
  u_ = x_2_ - x_;
  held_.reshape(response_.rows(), n);
  for (int c = 0, i = 0; c < n; ++c)
    for (const int end = (c + 1) * blocks; i < end; ++i) held_.lanes()[i] = response_.lanes()[i] + u_(c);
  process_.changes(end_, point_.chain, {x_.data(), f_.data(), point_.force}, held_, rates_, point_2_.force);
  f_2_ = f_;
  for (int c = 0; c < n; ++c) response_.lanes()[c * blocks].set(0, u_(c));
  minus_N_.reshape(response_.rows(), moving_);
  for (int c = 0, i = 0; c < moving_; ++c) {
    const double change = rates_.lanes()[c * blocks][0];
    f_2_(shape_.first + c) += change;
    for (const int end = (c + 1) * blocks; i < end; ++i) minus_N_.lanes()[i] = h * (change - rates_.lanes()[i]);
    minus_N_.lanes()[c * blocks].set(0, -h * change);
  }
  minus_N_.clear_padding();
  Z_ = h * A_;
  multiply(response_.columns(0, n), transposed(rows_from(shape_.first, right(Z_))), minus_N_.columns(0, moving_), true);
  D_.resize(moving_);
  for (int c = 0; c < moving_; ++c) {
    Lanes& of_x_2 = minus_N_.lanes()[c * blocks];
    D_(c) = -of_x_2[0];
    of_x_2.set(0, 0);
  }
  if (is_off_) {
    if (process_.is_plain()) {  // so that B has not been found as a matrix
      process_.jacobian_beside(step_, x_, point_.chain, A_2_);
      Z_0_ = h * (A_2_ - A_);
    }
    L_.noalias() = Z_0_.middleRows(shape_.first, moving_) * u_;
    D_ -= L_;
  }
  for (int c = 0; c < n; ++c) response_.lanes()[c * blocks].set(0, 0);
}

void ExponentialStep::set_both_parts(const Step& at, const KnownRates& known, const LaneMatrix& d, LaneMatrix& odd,
                                     Eigen::VectorXd& mean) {
  const int n = shape_.n, count = d.rows(), joints = process_.n_joints();
  const double half = 0.5 * step_.dt_s;
  pairs_.reshape(2 * count, n);
  for (int c = 0; c < n; ++c)
    for (int i = 0; i < count; ++i) {
      pairs_.view()(i, c) = d.view()(i, c);
      pairs_.view()(count + i, c) = -d.view()(i, c);
    }
  process_.changes(at, point_.chain, known, pairs_, pair_changes_);
  odd.reshape(count, moving_);
  multiply(d.columns(0, n), transposed(rows_from(shape_.first, right(Z_))), odd.columns(0, moving_), false);
  mean.resize(n);
  for (int c = 0; c < moving_; ++c) {
    const double* const plus = pair_changes_.view().col(c).data();
    const double* const minus = plus + count;
    double* const of_pair = odd.view().col(c).data();
    double sum = 0;
    for (int i = 0; i < count; ++i) {
      of_pair[i] = half * (plus[i] - minus[i]) - of_pair[i];
      sum += plus[i] + minus[i];
    }
    mean(shape_.first + c) = half * sum / count;
  }
  double of_chain[kMaxJoints];
  mobility_times(point_.chain, joints, point_.chain.curvature, of_chain);
  for (int k = 0; k < joints; ++k) mean(process_.layout().rate[k]) -= step_.dt_s * of_chain[k];
}

}  // namespace halyard

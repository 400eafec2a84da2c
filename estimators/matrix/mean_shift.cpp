#include "estimators/matrix/mean_shift.h"

#include <algorithm>
#include <cmath>

namespace halyard {

MeanShift::MeanShift(const PhiShape& shape) : shape_(shape), moving_(shape.end - shape.first) {
  variance_.resize(shape.n, PhiFunctions::kMostDoublings + 2);  // for any step
  at_left_.resize(shape.n);
  m_.resize(moving_);
  change_.resize(moving_);
}

void MeanShift::set_variances(const PhiFunctions& phi, int level, const LaneMatrix& S,
                              const Eigen::VectorXd& end_squares) {
  const int levels = phi.doublings() - level;
  set_squares(S, variance_.col(0).data());
  variance_.col(levels + 1) = end_squares;
  for (int k = levels; k > 0; --k) {
    set_product(S, transposed(rows_from(shape_.first, right(phi.level(level + k).E))), moving_, moved_);
    set_squares(moved_, variance_.col(levels + 1 - k).segment(shape_.first, moving_).data());
  }
}

void MeanShift::compute(const PhiFunctions& phi, int level, const LaneMatrix& S, const Eigen::VectorXd& end_squares,
                        const Eigen::VectorXd& first, const Eigen::VectorXd& last, LaneMatrix& shift) {
  const int levels = phi.doublings() - level;
  set_variances(phi, level, S, end_squares);
  shift.set_zero(shape_.n, 1);
  // From node to node: shift is the integral up to the left one.
  for (int node = 0; node <= levels; ++node) {
    const int k = node == 0 ? levels : levels + 1 - node;
    const double share = std::exp2(-k), left = node == 0 ? 0 : share, right_end = node == 0 ? share : 2 * share;
    for (int r = 0; r < moving_; ++r) {
      const int i = shape_.first + r;
      const double drop = share * (first(i) - last(i)), fall = variance_(i, 0) - variance_(i, levels + 1);
      double at_left = 1 - left, at_right = 1 - right_end, bump = 0;
      if (fall > 0) {
        const double a = variance_(i, node), b = variance_(i, node + 1);
        at_left = std::clamp((a - variance_(i, levels + 1)) / fall, 0.0, 1.0);
        at_right = std::clamp((b - variance_(i, levels + 1)) / fall, 0.0, 1.0);
        bump = std::min(2.0 / 3 * (0.5 * (a + b) - std::sqrt(a * b)) / fall, std::max(at_left, at_right));
      }
      m_(r) = share * last(i) + drop * (at_left - bump);
      change_(r) = drop * (at_right - at_left);
    }
    const PhiFunctions::Level& functions = phi.level(level + k);
    if (node > 0) {
      at_left_ = shift.view().col(0);
      set_product(functions.E, right(at_left_), 1, shift);
    }
    add_product(functions.phi_1, right(m_), shift);
    add_product(functions.phi_2, right(change_), shift);
  }
}

}  // namespace halyard

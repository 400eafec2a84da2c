#include "estimators/matrix/phi_functions.h"

#include <cmath>

namespace halyard {

void PhiFunctions::balance(Eigen::MatrixXd Z) {
  Eigen::ArrayXd scale = Eigen::ArrayXd::Ones(Z.rows());
  if (!Z.allFinite()) return set_weights(scale);
  constexpr int kSweeps = 10;
  bool changed = true;
  for (int sweep = 0; changed && sweep < kSweeps; ++sweep) {
    changed = false;
    for (Eigen::Index i = 0; i < Z.rows(); ++i) {
      const double own = std::abs(Z(i, i));
      const double column = Z.col(i).cwiseAbs().sum() - own, row = Z.row(i).cwiseAbs().sum() - own;
      if (!(column > 0 && row > 0) || (column < 2 * row && row < 2 * column)) continue;
      const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
      scale(i) *= factor;
      Z.col(i) *= factor;
      Z.row(i) /= factor;
      changed = true;
    }
  }
  set_weights(scale);
}

void PhiFunctions::set_weights(const Eigen::ArrayXd& scale) {
  const int n = static_cast<int>(scale.size());
  weight_.set_zero(n, n);
  for (int c = 0; c < n; ++c) weight_.view().col(c) = scale(c) / scale;
}

double PhiFunctions::distance(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) const {
  return (weight_.view().array() * (A - B).array()).abs().maxCoeff<Eigen::PropagateNaN>();
}

void PhiFunctions::take_memory(const PhiShape& shape) {
  const int n = shape.n, m = shape.end - shape.first;
  if (weight_.rows() != n) set_weights(Eigen::ArrayXd::Ones(n));
  if (n == shape_.n && shape.first == shape_.first && shape.end == shape_.end) return;
  shape_ = shape;
  levels_.resize(kMostDoublings + 1);
  memory_.clear();
  for (Level& level : levels_) {
    level.E.set_zero(n, n);
    level.E.view().diagonal().setOnes();
    for (LaneMatrix* A : {&level.phi_1, &level.phi_2, &level.phi_3}) A->set_zero(n, m);
    memory_.push_back({level.E.lanes(), level.phi_1.lanes(), level.phi_2.lanes(), level.phi_3.lanes()});
  }
  next_.set_zero(n, m);
  for (LaneMatrix* A : {&Y_, &Y2_, &Y3_}) A->set_zero(n, n);
}

bool PhiFunctions::compute(double h, const Eigen::MatrixXd& A, const PhiShape& shape) {
  take_memory(shape);
  set_block(A, Y_.view());
  Y_.set_lanes([&](std::size_t i) { return h * Y_.lanes()[i]; });
  doublings_ = widest_matrix_kernels().phi_functions(
      shape_, kMostDoublings, {memory_.data(), weight_.lanes(), Y_.lanes(), Y2_.lanes(), Y3_.lanes(), next_.lanes()});
  return doublings_ >= 0;
}

}  // namespace halyard

#include "estimators/matrix/phi_functions.h"

#include <cmath>
#include <utility>

namespace halyard {
void PhiFunctions::balance(Eigen::MatrixXd Z) {
  Eigen::ArrayXd scale = Eigen::ArrayXd::Ones(Z.rows());
  if (!Z.allFinite()) return set_units(scale);
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
  set_units(scale);
}

void PhiFunctions::set_units(const Eigen::ArrayXd& scale) {
  const int n = static_cast<int>(scale.size());
  unit_.set_zero(n, n);
  for (int c = 0; c < n; ++c) unit_.view().col(c) = scale / scale(c);
}

void PhiFunctions::take_memory(int n) {
  if (unit_.rows() != n) set_units(Eigen::ArrayXd::Ones(n));
  if (!levels_.empty() && levels_[0].E.rows() == n) return;
  levels_.resize(kMostDoublings + 1);
  for (Level& level : levels_)
    for (LaneMatrix* A : {&level.E, &level.phi_1, &level.phi_2}) A->set_zero(n, n);
}

/// The φ_k and E of Y.
void PhiFunctions::polynomials(Level& level) {
  const int n = Y_.rows();
  set_product(Y_, Y_.view(), Y2_);
  set_product(Y2_, Y_.view(), Y3_);
  const auto quadratic = [&](LaneMatrix& sum, double c_0, double c_1, double c_2) {
    sum.set_zero(n, n);
    sum.set_lanes([&](std::size_t i) { return c_1 * Y_.lanes()[i] + c_2 * Y2_.lanes()[i]; });
    sum.view().diagonal().array() += c_0;
  };
  // 1 / k! of k = 3 to 11, by Horner's scheme in Y³.
  quadratic(next_, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800);
  quadratic(level.E, 1.0 / 720, 1.0 / 5040, 1.0 / 40320);
  quadratic(phi_3_, 1.0 / 6, 1.0 / 24, 1.0 / 120);
  add_product(Y3_, next_.view(), level.E);
  add_product(Y3_, level.E.view(), phi_3_);
  const auto below = [&](const LaneMatrix& phi, double constant, LaneMatrix& lower) {
    lower.set_zero(n, n);
    lower.view().diagonal().setConstant(constant);
    add_product(Y_, phi.view(), lower);
  };
  below(phi_3_, 0.5, level.phi_2);
  below(level.phi_2, 1, level.phi_1);
  below(level.phi_1, 1, level.E);
}

void PhiFunctions::double_argument(const Level& half, Level& whole) {
  const Lanes *phi_1 = half.phi_1.lanes(), *phi_2 = half.phi_2.lanes();
  next_.set_lanes([&](std::size_t i) { return 0.5 * phi_1[i] + phi_2[i] + phi_3_.lanes()[i]; });
  add_product(half.E, phi_3_.view(), next_);
  phi_3_.set_lanes([&](std::size_t i) { return 0.125 * next_.lanes()[i]; });
  next_.set_lanes([&](std::size_t i) { return phi_1[i] + phi_2[i]; });
  add_product(half.E, half.phi_2.view(), next_);
  whole.phi_2.set_lanes([&](std::size_t i) { return 0.25 * next_.lanes()[i]; });
  next_.set_lanes([&](std::size_t i) { return phi_1[i]; });
  add_product(half.E, half.phi_1.view(), next_);
  whole.phi_1.set_lanes([&](std::size_t i) { return 0.5 * next_.lanes()[i]; });
  set_product(half.E, half.E.view(), whole.E);
}

void PhiFunctions::restore_units(LaneMatrix& A) const {
  A.set_lanes([&](std::size_t i) { return A.lanes()[i] * unit_.lanes()[i]; });
}

bool PhiFunctions::compute(const Eigen::Ref<const Eigen::MatrixXd>& Z) {
  constexpr double kMostNorm = 0.5;
  if (!Z.allFinite()) return false;
  const int n = static_cast<int>(Z.rows());
  take_memory(n);
  Y_.set_zero(n, n);
  Y_.view() = Z.array() / unit_.view().array();
  const double norm = Y_.view().cwiseAbs().colwise().sum().maxCoeff();
  int exponent = 0;
  std::frexp(norm / kMostNorm, &exponent);  // norm / kMostNorm < 2^exponent
  doublings_ = std::max(exponent, 1);
  if (!(doublings_ <= kMostDoublings)) return false;
  Y_.view() *= std::exp2(-doublings_);
  polynomials(levels_[static_cast<std::size_t>(doublings_)]);
  for (auto k = static_cast<std::size_t>(doublings_); k-- > 0;) double_argument(levels_[k + 1], levels_[k]);
  for (std::size_t k = 0; k <= static_cast<std::size_t>(doublings_); ++k)
    for (LaneMatrix* A : {&levels_[k].E, &levels_[k].phi_1, &levels_[k].phi_2}) restore_units(*A);
  restore_units(phi_3_);
  return true;
}

}  // namespace halyard

#include "estimators/matrix/phi_functions.h"

#include <cmath>
#include <utility>

namespace halyard {

void PhiFunctions::balance(Eigen::MatrixXd Z) {
  scale_.setOnes(Z.rows());
  if (!Z.allFinite()) return;
  constexpr int kSweeps = 10;
  bool changed = true;
  for (int sweep = 0; changed && sweep < kSweeps; ++sweep) {
    changed = false;
    for (Eigen::Index i = 0; i < Z.rows(); ++i) {
      const double own = std::abs(Z(i, i));
      const double column = Z.col(i).cwiseAbs().sum() - own, row = Z.row(i).cwiseAbs().sum() - own;
      if (!(column > 0 && row > 0) || (column < 2 * row && row < 2 * column)) continue;
      const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
      scale_(i) *= factor;
      Z.col(i) *= factor;
      Z.row(i) /= factor;
      changed = true;
    }
  }
}

/// The φ_k and E of Y.
void PhiFunctions::polynomials() {
  const int n = Y_.rows();
  set_product(Y_, Y_.view(), Y2_);
  set_product(Y2_, Y_.view(), Y3_);
  const auto Y = Y_.view(), Y2 = Y2_.view();
  const auto quadratic = [&](LaneMatrix& sum, double c_0, double c_1, double c_2) {
    sum.set_zero(n, n);
    auto S = sum.view();
    S = c_1 * Y + c_2 * Y2;
    S.diagonal().array() += c_0;
  };
  // 1 / k! of k = 3 to 11, by Horner's scheme in Y³.
  quadratic(next_[0], 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800);
  quadratic(next_[1], 1.0 / 720, 1.0 / 5040, 1.0 / 40320);
  quadratic(phi_[2], 1.0 / 6, 1.0 / 24, 1.0 / 120);
  add_product(Y3_, next_[0].view(), next_[1]);
  add_product(Y3_, next_[1].view(), phi_[2]);
  const auto below = [&](const LaneMatrix& phi, double constant, LaneMatrix& lower) {
    lower.set_zero(n, n);
    lower.view().diagonal().setConstant(constant);
    add_product(Y_, phi.view(), lower);
  };
  below(phi_[2], 0.5, phi_[1]);
  below(phi_[1], 1, phi_[0]);
  below(phi_[0], 1, E_);
}

void PhiFunctions::double_argument() {
  for (LaneMatrix& next : next_) next.set_zero(E_.rows(), E_.rows());
  next_[0].view() = phi_[0].view();
  next_[1].view() = phi_[0].view() + phi_[1].view();
  next_[2].view() = 0.5 * phi_[0].view() + phi_[1].view() + phi_[2].view();
  for (int k = 0; k < 3; ++k) {
    add_product(E_, phi_[k].view(), next_[k]);
    phi_[k].view() = std::exp2(-(k + 1)) * next_[k].view();
  }
  std::swap(E_, E_half_);
  set_product(E_half_, E_half_.view(), E_);
}

void PhiFunctions::restore_units(LaneMatrix& A) const {
  auto a = A.view();
  for (int c = 0; c < A.columns(); ++c) a.col(c).array() *= scale_ / scale_(c);
}

bool PhiFunctions::compute(const Eigen::Ref<const Eigen::MatrixXd>& Z) {
  constexpr double kMostNorm = 0.5;
  constexpr int kMostDoublings = 21;
  if (!Z.allFinite()) return false;
  const int n = static_cast<int>(Z.rows());
  if (scale_.size() != n) scale_.setOnes(n);
  Y_.set_zero(n, n);
  for (int c = 0; c < n; ++c) Y_.view().col(c) = Z.col(c).array() * (scale_(c) / scale_);
  const double norm = Y_.view().cwiseAbs().colwise().sum().maxCoeff();
  int exponent = 0;
  std::frexp(norm / kMostNorm, &exponent);  // norm / kMostNorm < 2^exponent
  const int doublings = std::max(exponent, 1);
  if (!(doublings <= kMostDoublings)) return false;
  Y_.view() *= std::exp2(-doublings);
  polynomials();
  parts_ = 1 << doublings;
  E_part_ = E_;
  for (int i = 0; i < doublings; ++i) double_argument();
  for (LaneMatrix* A : {&E_, &E_half_, &E_part_, &phi_[0], &phi_[1], &phi_[2]}) restore_units(*A);
  return true;
}

}  // namespace halyard

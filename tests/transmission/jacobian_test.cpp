#include "transmission/jacobian.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <stdexcept>

namespace halyard {
namespace {

/// y_r = Σ_c (r + 1) x_c² / 2, of `n` variables and three values.
auto squares(int n) {
  return [n](const Dual* x, Dual* y) {
    for (int r = 0; r < 3; ++r) {
      y[r] = Dual(0.0);
      for (int c = 0; c < n; ++c) y[r] = y[r] + Dual(0.5 * (r + 1)) * x[c] * x[c];
    }
  };
}

TEST(Jacobian, FillsItsPartOfAMatrixAndNoMore) {
  for (int n : {1, 3, 4, 5, 8, 9}) {
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 1, n);
    Eigen::VectorXd y(3);
    Eigen::MatrixXd whole = Eigen::MatrixXd::Constant(5, n + 2, -7);
    jacobian(squares(n), x, y, whole.block(1, 1, 3, n));
    for (int r = 0; r < 5; ++r)
      for (int c = 0; c < n + 2; ++c) {
        const bool inside = r >= 1 && r <= 3 && c >= 1 && c <= n;
        EXPECT_EQ(whole(r, c), inside ? r * c : -7) << n << ' ' << r << ' ' << c;
      }
    EXPECT_EQ(y(2), 1.5 * x.squaredNorm()) << n;
  }
}

TEST(Jacobian, RefusesMoreVariablesThanItHasRoomFor) {
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(kMaxJacobian + 1);
  Eigen::VectorXd y(3);
  Eigen::MatrixXd J(3, x.size());
  EXPECT_THROW(jacobian(squares(0), x, y, J), std::invalid_argument);
}

TEST(Jacobian, TakesAsManyVariablesAsItHasRoomFor) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(kMaxJacobian, 1, kMaxJacobian);
  Eigen::VectorXd y(3);
  Eigen::MatrixXd J(3, kMaxJacobian);
  jacobian(squares(kMaxJacobian), x, y, J);
  for (int c = 0; c < kMaxJacobian; ++c) EXPECT_EQ(J(2, c), 3 * x(c)) << c;
}

}  // namespace
}  // namespace halyard

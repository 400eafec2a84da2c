/// Products and triangular roots of small matrices, with every instruction set of this processor.

#include "estimators/matrix/matrix_kernels.h"

#include <gtest/gtest.h>

#include <random>

#include "estimators/matrix/lane_matrix.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

Eigen::MatrixXd random_matrix(int rows, int columns, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(random); });
}

LaneMatrix in_lanes(const Eigen::MatrixXd& A) {
  LaneMatrix lanes;
  lanes.set_zero(static_cast<int>(A.rows()), static_cast<int>(A.cols()));
  lanes.view() = A;
  return lanes;
}

/// L with L Lᵀ = A Aᵀ.
Eigen::MatrixXd lower_root_of(const MatrixKernels& kernels, const Eigen::MatrixXd& A) {
  LaneMatrix columns = in_lanes(A.transpose());
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(A.rows(), A.rows());
  kernels.lower_root(static_cast<int>(A.rows()), columns.blocks(), columns.lanes(), L.data(),
                     static_cast<int>(A.rows()));
  return L;
}

TEST(MatrixKernels, AddAProductOfAnySize) {
  for (const MatrixKernels& kernels : matrix_kernels())
    for (const int n : {1, 7, 8, 12, 21})
      for (const int m : {1, 4, 11}) {
        const Eigen::MatrixXd A = random_matrix(n, n, 1), B = random_matrix(n, m, 2), C = random_matrix(n, m, 3);
        LaneMatrix sum = in_lanes(C);
        kernels.add_product(sum.blocks(), n, m, in_lanes(A).lanes(), B.data(), n, sum.lanes());
        // n products below 1.
        EXPECT_LT((sum.view() - (C + A * B)).cwiseAbs().maxCoeff(), n * 2 * kEps) << kernels.name << n << m;
      }
}

TEST(MatrixKernels, ATriangularRootHasTheSquareOfTheMatrix) {
  for (const MatrixKernels& kernels : matrix_kernels())
    for (const int n : {1, 3, 8, 12, 17})
      for (const int m : {n, n + 5, 2 * n + 1}) {
        const Eigen::MatrixXd A = random_matrix(n, m, 4), L = lower_root_of(kernels, A);
        EXPECT_TRUE(L.isLowerTriangular(0)) << kernels.name << n;
        EXPECT_GE(L.diagonal().minCoeff(), 0) << kernels.name << n;
        // n reflections of columns of norm √m.
        EXPECT_LT((L * L.transpose() - A * A.transpose()).cwiseAbs().maxCoeff(), 10 * n * m * kEps)
            << kernels.name << n << m;
      }
}

TEST(MatrixKernels, ARootOfDependentRowsHasZerosOnItsDiagonal) {
  Eigen::MatrixXd A = random_matrix(4, 6, 5);
  A.row(0).setZero();
  A.row(2) = 2 * A.row(1);
  for (const MatrixKernels& kernels : matrix_kernels()) {
    const Eigen::MatrixXd L = lower_root_of(kernels, A);
    EXPECT_EQ(L.row(0).norm(), 0) << kernels.name;
    EXPECT_LT(L(2, 2), 20 * kEps) << kernels.name;
    EXPECT_LT((L * L.transpose() - A * A.transpose()).norm(), 100 * kEps) << kernels.name;
  }
}

}  // namespace
}  // namespace halyard

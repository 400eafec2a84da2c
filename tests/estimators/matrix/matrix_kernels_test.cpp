/// Products and triangular roots of small matrices, with every instruction set of this processor.

#include "estimators/matrix/matrix_kernels.h"

#include <gtest/gtest.h>

#include <random>
#include <unsupported/Eigen/MatrixFunctions>

#include "estimators/matrix/lane_matrix.h"
#include "tests/estimators/matrix/lane_matrices.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

Eigen::MatrixXd random_matrix(int rows, int columns, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(random); });
}

/// L with L Lᵀ = A Aᵀ.
Eigen::MatrixXd lower_root_of(const MatrixKernels& kernels, const Eigen::MatrixXd& A) {
  LaneMatrix columns = in_lanes(A);
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(A.rows(), A.rows());
  const int n = static_cast<int>(A.rows());
  kernels.lower_root(n, columns.columns(), n, columns.blocks(), columns.lanes(), L.data(), n);
  return L;
}

TEST(MatrixKernels, FormAndAddAProductOfAnySize) {
  for (const MatrixKernels& kernels : matrix_kernels())
    for (const int n : {1, 6, 7, 8, 12, 13, 15, 16, 18, 19, 21})
      for (const int m : {1, 4, 11}) {
        const Eigen::MatrixXd A = random_matrix(n, n, 1), B = random_matrix(n, m, 2), C = random_matrix(n, m, 3);
        LaneMatrix sum = in_lanes(C);
        const auto multiply = [&](const RightFactor& factor, bool add) {
          kernels.product(n, n, m, in_lanes(A).lanes(), sum.blocks(), factor, sum.lanes(), sum.blocks(), add);
        };
        multiply(right(B), true);
        // n products below 1.
        EXPECT_LT((sum.view() - (C + A * B)).cwiseAbs().maxCoeff(), n * 2 * kEps) << kernels.name << n << m;
        const Eigen::MatrixXd B_transposed = B.transpose();
        multiply(transposed(right(B_transposed)), false);
        EXPECT_LT((sum.view() - A * B).cwiseAbs().maxCoeff(), n * 2 * kEps) << kernels.name << n << m;
      }
}

TEST(MatrixKernels, AProductLeavesTheRowsBeyondItsOwn) {
  const Eigen::MatrixXd A = random_matrix(20, 12, 6), B = random_matrix(12, 5, 7), C = Eigen::MatrixXd::Ones(20, 5);
  for (const MatrixKernels& kernels : matrix_kernels()) {
    LaneMatrix sum = in_lanes(C);
    kernels.product(8, 12, 5, in_lanes(A).lanes(), sum.blocks(), right(B), sum.lanes(), sum.blocks(), false);
    EXPECT_EQ(sum.view().bottomRows(12), C.bottomRows(12)) << kernels.name;
    EXPECT_LT((sum.view() - A * B).topRows(8).cwiseAbs().maxCoeff(), 12 * 2 * kEps) << kernels.name;
  }
}

TEST(MatrixKernels, TheFunctionsOfAllInstructionSetsAgree) {
  constexpr int kSize = 13, kMost = 5;
  const Eigen::MatrixXd Z = random_matrix(kSize, kSize, 8);
  Eigen::MatrixXd first;
  for (const MatrixKernels& kernels : matrix_kernels()) {
    std::vector<LaneMatrix> memory(4 * (kMost + 1) + 3, in_lanes(Eigen::MatrixXd::Zero(kSize, kSize)));
    std::vector<PhiLevelMemory> levels;
    for (std::size_t k = 0; k <= 4 * kMost; k += 4)
      levels.push_back({memory[k].lanes(), memory[k + 1].lanes(), memory[k + 2].lanes(), memory[k + 3].lanes()});
    const std::size_t rest = 4 * (kMost + 1);
    LaneMatrix unit = in_lanes(Eigen::MatrixXd::Ones(kSize, kSize)), Y = in_lanes(Z);
    ASSERT_EQ(kernels.phi_functions({kSize, 0, kSize}, kMost,
                                    {levels.data(), unit.lanes(), Y.lanes(), memory[rest].lanes(),
                                     memory[rest + 1].lanes(), memory[rest + 2].lanes()}),
              2)
        << kernels.name;
    Eigen::MatrixXd all(kSize, 4 * kSize);
    all << memory[0].view(), memory[1].view(), memory[2].view(), memory[3].view();
    if (first.size() == 0) first = all;
    // A few roundings of entries of about 10, in each of the doublings.
    EXPECT_LT((all - first).cwiseAbs().maxCoeff(), 1e-12) << kernels.name;
    // The polynomial's remainder, 2e-8 at most, doubled twice.
    EXPECT_LT((all.leftCols(kSize) - Z.exp()).cwiseAbs().maxCoeff(), 1e-6) << kernels.name;
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

TEST(MatrixKernels, AFewReflectionsLeaveARootOfTheRest) {
  constexpr int kSize = 15, kSteps = 3;
  const Eigen::MatrixXd A = random_matrix(kSize, kSize + 2, 9);
  for (const MatrixKernels& kernels : matrix_kernels()) {
    LaneMatrix columns = in_lanes(A);
    Eigen::MatrixXd L(kSize, kSteps);
    kernels.lower_root(kSize, columns.columns(), kSteps, columns.blocks(), columns.lanes(), L.data(), kSize);
    EXPECT_LT((L - lower_root_of(kernels, A).leftCols(kSteps)).norm(), 100 * kEps) << kernels.name;
    const auto B = columns.view().bottomRightCorner(kSize - kSteps, kSize + 2 - kSteps);
    const Eigen::MatrixXd rest = A * A.transpose() - L * L.transpose();
    // As of a whole root.
    EXPECT_LT((B * B.transpose() - rest.bottomRightCorner(kSize - kSteps, kSize - kSteps)).cwiseAbs().maxCoeff(),
              10 * kSize * (kSize + 2) * kEps)
        << kernels.name;
  }
}

TEST(MatrixKernels, ACorrectionIsThatOfTheCovariances) {
  for (const MatrixKernels& kernels : matrix_kernels())
    for (const int n : {1, 4, 12, 15, 18, 27})
      for (const int m : {1, 3}) {
        const Eigen::MatrixXd S = random_matrix(n, n, 12), H = random_matrix(m, n, 13), P = S * S.transpose();
        LaneMatrix root = in_lanes(S), gain = in_lanes(Eigen::MatrixXd::Zero(n, m));
        Eigen::MatrixXd L(m, m);
        kernels.correct(n, m, root.blocks(), H.data(), m, root.lanes(), gain.lanes(), L.data(), m);
        const Eigen::MatrixXd G = gain.view(), after = root.view();
        // m corrections of sums of n products of n products below 1.
        const double tolerance = 10 * m * n * n * kEps;
        EXPECT_TRUE(L.isLowerTriangular(0)) << kernels.name << n << m;
        EXPECT_LT((L * L.transpose() - H * P * H.transpose() - Eigen::MatrixXd::Identity(m, m)).norm(), tolerance);
        EXPECT_LT((G * L.transpose() - P * H.transpose()).norm(), tolerance) << kernels.name << n << m;
        EXPECT_LT((after * after.transpose() - P + G * G.transpose()).norm(), tolerance) << kernels.name << n << m;
      }
}

/// check(kernels, rows, columns) for parts of several sizes.
template <class Check>
void for_parts(const Check& check) {
  for (const MatrixKernels& kernels : matrix_kernels())
    for (const int rows : {1, 3, 8, 12, 17})
      for (const int columns : {1, 6, 12}) check(kernels, rows, columns);
}

TEST(MatrixKernels, CopyAnyPartOfAMatrix) {
  const Eigen::MatrixXd A = random_matrix(19, 13, 11);
  for_parts([&](const MatrixKernels& kernels, int rows, int columns) {
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(20, 14), expected = B;
    expected.block(2, 1, rows, columns) = A.block(1, 1, rows, columns);
    kernels.copy(rows, columns, &A(1, 1), 19, &B(2, 1), 20);
    EXPECT_EQ(B, expected) << kernels.name << rows << columns;
  });
}

TEST(MatrixKernels, TransposeAnyPartOfAMatrix) {
  const Eigen::MatrixXd A = random_matrix(19, 13, 11);
  for_parts([&](const MatrixKernels& kernels, int rows, int columns) {
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(14, 20), expected = B;
    expected.block(2, 1, columns, rows) = A.block(1, 1, rows, columns).transpose();
    kernels.transpose(rows, columns, &A(1, 1), 19, &B(2, 1), 14);
    EXPECT_EQ(B, expected) << kernels.name << rows << columns;
  });
}

TEST(MatrixKernels, SquaresOfColumnsAreSummed) {
  for (const int rows : {1, 8, 12, 19}) {
    const Eigen::MatrixXd A = random_matrix(rows, 5, 10);
    for (const MatrixKernels& kernels : matrix_kernels()) {
      const LaneMatrix lanes = in_lanes(A);
      Eigen::VectorXd squares(5);
      kernels.column_squares(rows, 5, lanes.lanes(), lanes.blocks(), squares.data());
      // Sums of up to 19 numbers below 1.
      EXPECT_LT((squares - A.colwise().squaredNorm().transpose()).norm(), 19 * 5 * kEps) << kernels.name << rows;
    }
  }
}

TEST(MatrixKernels, SquaresOfRowsAreSummed) {
  for (const int rows : {1, 8, 12, 19}) {
    const Eigen::MatrixXd A = random_matrix(rows, 7, 11);
    for (const MatrixKernels& kernels : matrix_kernels()) {
      const LaneMatrix lanes = in_lanes(A);
      for (const int count : {1, 5, 6}) {
        Eigen::VectorXd squares = Eigen::VectorXd::Constant(rows + 1, -1);
        kernels.row_squares(rows, count, lanes.lanes(), lanes.blocks(), squares.data());
        // Sums of up to 6 numbers below 1.
        EXPECT_LT((squares.head(rows) - A.leftCols(count).rowwise().squaredNorm()).norm(), 6 * rows * kEps)
            << kernels.name << rows << count;
        EXPECT_EQ(squares(rows), -1) << kernels.name << rows << count;
      }
    }
  }
}

TEST(MatrixKernels, AProductLeavesTheColumnsBesideItsOwn) {
  const Eigen::MatrixXd A = random_matrix(12, 12, 6), B = random_matrix(12, 9, 7), C = Eigen::MatrixXd::Ones(12, 9);
  for (const MatrixKernels& kernels : matrix_kernels())
    for (int m = 1; m < 9; ++m) {
      LaneMatrix sum = in_lanes(C);
      kernels.product(12, 12, m, in_lanes(A).lanes(), sum.blocks(), right(B), sum.lanes(), sum.blocks(), false);
      EXPECT_EQ(sum.view().rightCols(9 - m), C.rightCols(9 - m)) << kernels.name << m;
      EXPECT_LT((sum.view() - A * B).leftCols(m).cwiseAbs().maxCoeff(), 12 * 2 * kEps) << kernels.name << m;
    }
}

TEST(MatrixKernels, ARootIsThatOfTheColumnsThatItIsToldOf) {
  for (const MatrixKernels& kernels : matrix_kernels())
    for (const int n : {1, 3, 8, 12, 17})
      for (const int m : {n, n + 1, 2 * n + 1}) {
        Eigen::MatrixXd A = random_matrix(n, m + 2, 4);
        A.rightCols(2).setConstant(kNan);
        LaneMatrix columns = in_lanes(A);
        Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
        kernels.lower_root(n, m, n, columns.blocks(), columns.lanes(), L.data(), n);
        const Eigen::MatrixXd square = A.leftCols(m) * A.leftCols(m).transpose();
        // n reflections of columns of norm √m.
        EXPECT_LT((L * L.transpose() - square).norm(), 10 * n * n * m * kEps) << kernels.name << n << m;
      }
}

TEST(MatrixKernels, ACorrectionTakesAndWritesNothingBesideItsOwn) {
  for (const MatrixKernels& kernels : matrix_kernels())
    for (const int n : {1, 4, 8, 12, 17})
      for (const int m : {1, 3}) {
        const Eigen::MatrixXd S = random_matrix(n, n, 12), P = S * S.transpose();
        Eigen::MatrixXd H = random_matrix(m, n + 1, 13), wide(n, n + 1);
        H.rightCols(1).setOnes();
        wide << S, Eigen::VectorXd::Constant(n, kNan);
        LaneMatrix root = in_lanes(wide), gain = in_lanes(Eigen::MatrixXd::Constant(n, m + 1, 7));
        Eigen::MatrixXd L = Eigen::MatrixXd::Constant(m + 1, m + 1, 7);
        kernels.correct(n, m, root.blocks(), H.data(), m, root.lanes(), gain.lanes(), L.data(), m + 1);
        const Eigen::MatrixXd G = gain.view().leftCols(m), after = root.view().leftCols(n), own = L.topLeftCorner(m, m),
                              of_states = H.leftCols(n),
                              before = of_states * P * of_states.transpose() + Eigen::MatrixXd::Identity(m, m);
        const double tolerance = 10 * m * n * n * kEps;  // as of a whole matrix
        EXPECT_LT((own * own.transpose() - before).norm(), tolerance) << kernels.name << n << m;
        EXPECT_LT((G * own.transpose() - P * of_states.transpose()).norm(), tolerance) << kernels.name << n << m;
        EXPECT_LT((after * after.transpose() - P + G * G.transpose()).norm(), tolerance) << kernels.name << n << m;
        EXPECT_EQ(L.rightCols(1), Eigen::MatrixXd::Constant(m + 1, 1, 7)) << kernels.name << n << m;
        EXPECT_EQ(L.bottomRows(1), Eigen::MatrixXd::Constant(1, m + 1, 7)) << kernels.name << n << m;
        EXPECT_EQ(gain.view().rightCols(1), Eigen::MatrixXd::Constant(n, 1, 7)) << kernels.name << n << m;
      }
}

}  // namespace
}  // namespace halyard

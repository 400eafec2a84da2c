/// Matrices in lanes: what reshaping keeps, and parts as factors.

#include "estimators/matrix/lane_matrix.h"

#include <gtest/gtest.h>

#include "tests/estimators/matrix/lane_matrices.h"

namespace halyard {
namespace {

/// Entry (r, c) is 10 r + c + 1.
Eigen::MatrixXd counted(int rows, int columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [](Eigen::Index r, Eigen::Index c) { return 10.0 * r + c + 1; });
}

TEST(LaneMatrix, ReshapingKeepsTheEntriesUnlessTheShapeChanges) {
  LaneMatrix A = in_lanes(counted(9, 3));
  A.reshape(9, 3);
  EXPECT_EQ(A.view(), counted(9, 3));
  for (const auto& [rows, columns] : {std::pair(9, 4), std::pair(10, 4)}) {
    A.reshape(rows, columns);
    EXPECT_EQ(A.rows(), rows);
    EXPECT_EQ(A.columns(), columns);
    EXPECT_EQ(A.view(), Eigen::MatrixXd::Zero(rows, columns));
    A.view().setOnes();
  }
}

TEST(LaneMatrix, ClearingThePaddingLeavesTheRows) {
  for (const int rows : {3, 8, 11}) {
    LaneMatrix A = in_lanes(counted(rows, 2));
    for (int c = 0; c < 2; ++c)
      for (int lane = rows % kLaneWidth; rows % kLaneWidth > 0 && lane < kLaneWidth; ++lane)
        A.lanes()[(c + 1) * A.blocks() - 1].set(lane, 7);
    A.clear_padding();
    EXPECT_EQ(A.view(), counted(rows, 2)) << rows;
    for (int c = 0; c < 2; ++c)
      for (int lane = rows % kLaneWidth; rows % kLaneWidth > 0 && lane < kLaneWidth; ++lane)
        EXPECT_EQ(A.lanes()[(c + 1) * A.blocks() - 1][lane], 0) << rows;
  }
}

TEST(LaneMatrix, SomeRowsOfAFactorOrOfItsTransposeMultiply) {
  const LaneMatrix A = in_lanes(counted(9, 4));
  const Eigen::MatrixXd B = counted(6, 5), B_transposed = B.transpose();
  for (const RightFactor& factor : {right(B), transposed(right(B_transposed))}) {
    LaneMatrix C;
    set_product(A, rows_from(2, factor), 5, C);
    // Whole numbers.
    EXPECT_EQ(C.view(), counted(9, 4) * B.bottomRows(4));
  }
}

}  // namespace
}  // namespace halyard

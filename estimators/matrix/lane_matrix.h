#pragma once
/// A matrix whose columns are padded with zeros to whole lanes, as the kernels of matrix_kernels.h take it.

#include <Eigen/Core>
#include <vector>

#include "estimators/matrix/matrix_kernels.h"

namespace halyard {

class LaneMatrix {
 public:
  using View = Eigen::Map<Eigen::MatrixXd, Eigen::Aligned16, Eigen::OuterStride<>>;
  using ConstView = Eigen::Map<const Eigen::MatrixXd, Eigen::Aligned16, Eigen::OuterStride<>>;

  /// All entries zero. Keeps its memory.
  void set_zero(int rows, int columns) {
    rows_ = rows, columns_ = columns, blocks_ = (rows + kLaneWidth - 1) / kLaneWidth;
    lanes_.assign(static_cast<std::size_t>(blocks_) * columns, Lanes(0.0));
  }
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  int blocks() const { return blocks_; }  ///< lanes of a column
  Lanes* lanes() { return lanes_.data(); }
  const Lanes* lanes() const { return lanes_.data(); }
  View view() { return {reinterpret_cast<double*>(lanes_.data()), rows_, columns_, stride()}; }
  ConstView view() const { return {reinterpret_cast<const double*>(lanes_.data()), rows_, columns_, stride()}; }

 private:
  Eigen::OuterStride<> stride() const { return Eigen::OuterStride<>(kLaneWidth * blocks_); }

  int rows_ = 0, columns_ = 0, blocks_ = 0;
  std::vector<Lanes> lanes_;
};

/// C += A B. C and B must not share memory.
inline void add_product(const LaneMatrix& A, const Eigen::Ref<const Eigen::MatrixXd>& B, LaneMatrix& C) {
  matrix_kernels()[0].add_product(A.blocks(), A.columns(), static_cast<int>(B.cols()), A.lanes(), B.data(),
                                  static_cast<int>(B.outerStride()), C.lanes());
}

/// C = A B. C and B must not share memory.
inline void set_product(const LaneMatrix& A, const Eigen::Ref<const Eigen::MatrixXd>& B, LaneMatrix& C) {
  C.set_zero(A.rows(), static_cast<int>(B.cols()));
  add_product(A, B, C);
}

}  // namespace halyard

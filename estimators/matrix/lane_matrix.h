#pragma once
/// A matrix whose columns are padded with zeros to whole lanes, as the kernels of matrix_kernels.h take it.

#include <Eigen/Core>
#include <cstring>
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
    lanes_.resize(static_cast<std::size_t>(blocks_) * columns);
    std::memset(static_cast<void*>(lanes_.data()), 0, lanes_.size() * sizeof(Lanes));
  }
  /// Each block of lanes becomes entry(i), i its index. entry() has to give zero between the rows and the lanes' end.
  template <class Entry>
  void set_lanes(const Entry& entry) {
    for (std::size_t i = 0; i < lanes_.size(); ++i) lanes_[i] = entry(i);
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

/// squares(r) becomes the sum of the squares of row r, of the first `columns` columns of A. squares: [A.blocks()].
inline void set_row_squares(const LaneMatrix& A, int columns, Lanes* squares) {
  for (int b = 0; b < A.blocks(); ++b) {
    Lanes sum(0.0);
    for (int c = 0; c < columns; ++c) sum += A.lanes()[c * A.blocks() + b] * A.lanes()[c * A.blocks() + b];
    squares[b] = sum;
  }
}

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

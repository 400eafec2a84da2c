#pragma once
/// A matrix whose columns are padded with zeros to whole lanes, as the kernels of matrix_kernels.h take it.

#include <Eigen/Core>
#include <cstring>
#include <vector>

#include "estimators/matrix/matrix_kernels.h"

namespace halyard {

/// Some neighbouring columns of a matrix in lanes.
template <class L>
struct LaneColumns {
  int rows, count, blocks;
  L* lanes;
  operator LaneColumns<const L>() const { return {rows, count, blocks, lanes}; }  // NOLINT: as of pointers
};

class LaneMatrix {
 public:
  using View = Eigen::Map<Eigen::MatrixXd, Eigen::Aligned16, Eigen::OuterStride<>>;
  using ConstView = Eigen::Map<const Eigen::MatrixXd, Eigen::Aligned16, Eigen::OuterStride<>>;

  /// All entries zero. Keeps its memory.
  void set_zero(int rows, int columns) {
    rows_ = rows, columns_ = columns, blocks_ = (rows + kLaneWidth - 1) / kLaneWidth;
    lanes_.resize(static_cast<std::size_t>(blocks_) * columns);
    if (!lanes_.empty()) std::memset(static_cast<void*>(lanes_.data()), 0, lanes_.size() * sizeof(Lanes));
  }
  /// The entries are zero if the shape changes, else what they were. Keeps its memory.
  void reshape(int rows, int columns) {
    if (rows != rows_ || columns != columns_) set_zero(rows, columns);
  }
  /// Each block of lanes becomes entry(i), i its index. entry() has to give zero between the rows and the lanes' end.
  template <class Entry>
  void set_lanes(const Entry& entry) {
    for (std::size_t i = 0; i < lanes_.size(); ++i) lanes_[i] = entry(i);
  }
  /// The entries between the rows and the lanes' end become zero.
  void clear_padding() {
    for (int c = 0, used = rows_ % kLaneWidth; used > 0 && c < columns_; ++c)
      for (int lane = used; lane < kLaneWidth; ++lane)
        lanes_[static_cast<std::size_t>((c + 1) * blocks_ - 1)].set(lane, 0);
  }
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  int blocks() const { return blocks_; }  ///< lanes of a column
  Lanes* lanes() { return lanes_.data(); }
  const Lanes* lanes() const { return lanes_.data(); }
  LaneColumns<Lanes> columns(int first, int count) { return {rows_, count, blocks_, lanes() + first * blocks_}; }
  LaneColumns<const Lanes> columns(int first, int count) const {
    return {rows_, count, blocks_, lanes() + first * blocks_};
  }
  View view() { return {reinterpret_cast<double*>(lanes_.data()), rows_, columns_, stride()}; }
  ConstView view() const { return {reinterpret_cast<const double*>(lanes_.data()), rows_, columns_, stride()}; }

 private:
  Eigen::OuterStride<> stride() const { return Eigen::OuterStride<>(kLaneWidth * blocks_); }

  int rows_ = 0, columns_ = 0, blocks_ = 0;
  std::vector<Lanes> lanes_;
};

/// Factors of products.
inline RightFactor right(const Eigen::Ref<const Eigen::MatrixXd>& B) {
  return {B.data(), 1, static_cast<int>(B.outerStride())};
}
inline RightFactor right(const LaneMatrix& B) { return {B.view().data(), 1, kLaneWidth * B.blocks()}; }
inline RightFactor transposed(RightFactor B) { return {B.data, B.column, B.row}; }

inline RightFactor right(const LaneColumns<const Lanes>& B) {
  return {reinterpret_cast<const double*>(B.lanes), 1, kLaneWidth * B.blocks};
}
/// The rows of B from `first` on.
inline RightFactor rows_from(int first, RightFactor B) { return {B.data + first * B.row, B.row, B.column}; }

/// C = A B, or C += A B if `add`, with B [A.count x C.count]. C must not share memory with the factors.
inline void multiply(const LaneColumns<const Lanes>& A, const RightFactor& B, const LaneColumns<Lanes>& C, bool add) {
  widest_matrix_kernels().product(A.rows, A.count, C.count, A.lanes, A.blocks, B, C.lanes, C.blocks, add);
}
inline void add_product(const LaneMatrix& A, const RightFactor& B, LaneMatrix& C) {
  multiply(A.columns(0, A.columns()), B, C.columns(0, C.columns()), true);
}
/// C takes the shape of the product, with B [A.columns() x columns].
inline void set_product(const LaneMatrix& A, const RightFactor& B, int columns, LaneMatrix& C) {
  C.reshape(A.rows(), columns);
  multiply(A.columns(0, A.columns()), B, C.columns(0, columns), false);
}

/// Sums of the squares of the columns of A: squares [A.columns()].
inline void set_squares(const LaneMatrix& A, double* squares) {
  widest_matrix_kernels().column_squares(A.rows(), A.columns(), A.lanes(), A.blocks(), squares);
}

/// B = A, of like shape, with memory of columns as Eigen and LaneMatrix::view() have it. This and the next take half
/// the time of Eigen's for small matrices.
template <class A_t, class B_t>
void set_block(const A_t& A, B_t&& B) {
  widest_matrix_kernels().copy(static_cast<int>(A.rows()), static_cast<int>(A.cols()), A.data(),
                               static_cast<int>(A.outerStride()), B.data(), static_cast<int>(B.outerStride()));
}
/// B = Aᵀ.
template <class A_t, class B_t>
void set_transposed(const A_t& A, B_t&& B) {
  widest_matrix_kernels().transpose(static_cast<int>(A.rows()), static_cast<int>(A.cols()), A.data(),
                                    static_cast<int>(A.outerStride()), B.data(), static_cast<int>(B.outerStride()));
}
/// The rows of B from `first` on become Aᵀ.
inline void set_rows_transposed(const Eigen::Ref<const Eigen::MatrixXd>& A, LaneMatrix& B, int first) {
  set_transposed(A, B.view().middleRows(first, A.cols()));
}

/// Sums of the squares of the rows of the first `count` columns of A: squares [A.rows()].
inline void set_row_squares(const LaneMatrix& A, int count, double* squares) {
  widest_matrix_kernels().row_squares(A.rows(), count, A.lanes(), A.blocks(), squares);
}

}  // namespace halyard

#pragma once
/// Products of small matrices in tiles that stay in the registers, for the files that are compiled once for each
/// instruction set (matrix_kernels.h). All functions are forced inline.
///
/// A tile is up to three registers of rows by four columns: twelve sums, three entries of A and one of B fill the
/// sixteen registers that AVX2 has. Rows are counted in registers (pieces), so that twelve rows cost no more than three
/// of them.

#include <utility>

#include "transmission/scalar.h"

namespace halyard::tiles {

using Piece = Lanes::Vector::Piece;
inline constexpr int kPieceWidth = kRegisterWidth;
inline constexpr int kPiecesPerBlock = kLaneWidth / kPieceWidth;

HALYARD_INLINE const Piece* pieces(const Lanes* a) { return reinterpret_cast<const Piece*>(a); }
HALYARD_INLINE Piece* pieces(Lanes* a) { return reinterpret_cast<Piece*>(a); }
HALYARD_INLINE int pieces_of(int rows) { return (rows + kPieceWidth - 1) / kPieceWidth; }
HALYARD_INLINE Piece all(double s) { return s - Piece{}; }

/// The right factor: entry (l, c) is at data[l row + c column].
struct Right {
  const double* data;
  int row, column;
};

/// put(p, c, sum) of the entries of A B in `height` registers of rows from `p` on, `width` columns from `c` on.
template <int height, int width, class Put>
HALYARD_INLINE void tile(int p, int c, int k, const Piece* A, int a_stride, const Right& B, const Put& put) {
  Piece sum[height][width];
  _Pragma("GCC unroll 4") for (int i = 0; i < height; ++i) _Pragma("GCC unroll 4") for (int j = 0; j < width; ++j)
      sum[i][j] = Piece{};
  const Piece* a = A + p;
  const double* b = B.data + c * B.column;
  _Pragma("GCC unroll 4") for (int l = 0; l < k; ++l, a += a_stride, b += B.row)
      _Pragma("GCC unroll 4") for (int j = 0; j < width; ++j) {
    const Piece factor = all(b[j * B.column]);
    _Pragma("GCC unroll 4") for (int i = 0; i < height; ++i) sum[i][j] += a[i] * factor;
  }
  _Pragma("GCC unroll 4") for (int i = 0; i < height; ++i) _Pragma("GCC unroll 4") for (int j = 0; j < width; ++j)
      put(p + i, c + j, sum[i][j]);
}

template <int width, class Put>
HALYARD_INLINE void columns_of_product(int c, int height, int k, const Piece* A, int a_stride, const Right& B,
                                       const Put& put) {
  int p = 0;
  for (; p + 3 <= height; p += 3) tile<3, width>(p, c, k, A, a_stride, B, put);
  if (p + 2 == height) tile<2, width>(p, c, k, A, a_stride, B, put);
  if (p + 1 == height) tile<1, width>(p, c, k, A, a_stride, B, put);
}

/// put(p, c, entries) of A B, with A in `height` registers of rows [any x k], a_stride registers apart, and B [k x m].
template <class Put>
HALYARD_INLINE void product(int height, int k, int m, const Piece* A, int a_stride, const Right& B, const Put& put) {
  int c = 0;
  for (; c + 4 <= m; c += 4) columns_of_product<4>(c, height, k, A, a_stride, B, put);
  if (c + 2 <= m) columns_of_product<2>(c, height, k, A, a_stride, B, put), c += 2;
  if (c < m) columns_of_product<1>(c, height, k, A, a_stride, B, put);
}

/// Sum of the entries, by halves.
template <int width>
HALYARD_INLINE double sum_of_entries(const double __attribute__((vector_size(8 * width))) & a) {
  if constexpr (width == 2) {
    return a[0] + a[1];
  } else {
    typedef double Half __attribute__((vector_size(4 * width)));
    Half half[2];
    __builtin_memcpy(half, &a, sizeof(a));
    return sum_of_entries<width / 2>(half[0] + half[1]);
  }
}
HALYARD_INLINE double sum_of(const Piece& a) { return sum_of_entries<kPieceWidth>(a); }
HALYARD_INLINE double sum_of(const Lanes& a) {
  Piece sum = a.v.piece[0];
  for (int i = 1; i < kPiecesPerBlock; ++i) sum += a.v.piece[i];
  return sum_of(sum);
}

/// Rows a and b, `distance` apart, exchange blocks of that size: the right ones of a with the left ones of b.
template <int distance, class Row, int... i>
HALYARD_INLINE void exchange_blocks(Row& a, Row& b, std::integer_sequence<int, i...>) {
  constexpr int width = sizeof...(i);
  const Row low = __builtin_shufflevector(a, b, (i & distance ? i - distance + width : i)...);
  b = __builtin_shufflevector(a, b, (i & distance ? i + width : i + distance)...);
  a = low;
}

/// Transposes rows of `width` entries, by blocks of half the size from stage to stage.
template <int width, int distance, class Row>
HALYARD_INLINE void transpose_rows(Row* rows) {
  _Pragma("GCC unroll 8") for (int r = 0; r < width; ++r) if ((r & distance) == 0)
      exchange_blocks<distance>(rows[r], rows[r + distance], std::make_integer_sequence<int, width>());
  if constexpr (distance > 1) transpose_rows<width, distance / 2>(rows);
}

/// B = Aᵀ, [width x width]; strides: of columns.
template <int width>
HALYARD_INLINE void transpose_tile(const double* A, int a_stride, double* B, int b_stride) {
  if constexpr (width == 1) {
    *B = *A;
  } else {
    typedef double Row __attribute__((vector_size(8 * width)));
    Row rows[width];
    _Pragma("GCC unroll 8") for (int i = 0; i < width; ++i) __builtin_memcpy(rows + i, A + i * a_stride, sizeof(Row));
    transpose_rows<width, width / 2>(rows);
    _Pragma("GCC unroll 8") for (int i = 0; i < width; ++i) __builtin_memcpy(B + i * b_stride, rows + i, sizeof(Row));
  }
}

}  // namespace halyard::tiles

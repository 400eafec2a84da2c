/// The kernels of matrix_kernels.h, for the instruction set that the including file is compiled for.
/// No include guard: each kernels_<set>.cpp includes it exactly once.

#include "estimators/matrix/phi_kernel_body.h"

namespace halyard {
namespace {

using tiles::Piece, tiles::pieces, tiles::pieces_of, tiles::kPiecesPerBlock, tiles::sum_of;

/// product() with a column stride that the compiler may know. known_k: k, or 0 if the compiler is not to know it.
template <int known_k>
HALYARD_INLINE void product_of(int rows, int k, int m, const Lanes* A, int a_blocks, const tiles::Right& B, Lanes* C,
                               int c_blocks, bool add) {
  Piece* out = pieces(C);
  const int c_stride = c_blocks * kPiecesPerBlock;
  tiles::product(
      pieces_of(rows), known_k > 0 ? known_k : k, m, pieces(A), a_blocks * kPiecesPerBlock,
      B, [&](int p, int c, const Piece& sum) __attribute__((always_inline)) {
        Piece& entry = out[p + c * c_stride];
        entry = add ? entry + sum : sum;
      });
}

template <int known_k>
void product_with(int rows, int k, int m, const Lanes* A, int a_blocks, const RightFactor& B, Lanes* C, int c_blocks,
                  bool add) {
  if (B.column == 1) product_of<known_k>(rows, k, m, A, a_blocks, {B.data, B.row, 1}, C, c_blocks, add);
  else product_of<known_k>(rows, k, m, A, a_blocks, {B.data, B.row, B.column}, C, c_blocks, add);
}

void product(int rows, int k, int m, const Lanes* A, int a_blocks, const RightFactor& B, Lanes* C, int c_blocks,
             bool add) {
  const auto with = k == 12 ? product_with<12> : k == 6 ? product_with<6> : product_with<0>;
  with(rows, k, m, A, a_blocks, B, C, c_blocks, add);
}

/// A reflection of the rows of A from the right that leaves only entry i of row i, which becomes `image`: with v that row
/// less image e_i, A -= (A v) vᵀ factor.
struct Reflection {
  int i, columns, stride;  ///< columns: of A; stride: registers of a column
  double image, factor;
};

/// f<height>(p) for the registers from `first` to `end`, p the first of at most three; the lowest come last.
template <class F>
HALYARD_INLINE void from_the_end(int first, int end, const F& f) {
  int p = end;
  while (p - first >= 3) p -= 3, f.template operator()<3>(p);
  if (p - first == 2) f.template operator()<2>(first);
  if (p - first == 1) f.template operator()<1>(first);
}

/// w = A times row i, of the columns from i on. A, w: at the first of these registers; row: entry i of column 0.
template <int height>
HALYARD_INLINE void project(const Reflection& r, const Piece* A, const double* row, Piece* w) {
  Piece sum[2][height];
  _Pragma("GCC unroll 3") for (int h = 0; h < height; ++h) sum[0][h] = sum[1][h] = Piece{};
  const int row_step = r.stride * tiles::kPieceWidth;
  int c = r.i;
  for (; c + 2 <= r.columns; c += 2) _Pragma("GCC unroll 2") for (int odd = 0; odd < 2; ++odd) {
      const Piece factor = tiles::all(row[(c + odd) * row_step]);
      _Pragma("GCC unroll 3") for (int h = 0; h < height; ++h) sum[odd][h] += factor * A[(c + odd) * r.stride + h];
    }
  if (c < r.columns)
    _Pragma("GCC unroll 3") for (int h = 0; h < height; ++h) sum[0][h] +=
        tiles::all(row[c * row_step]) * A[c * r.stride + h];
  _Pragma("GCC unroll 3") for (int h = 0; h < height; ++h) w[h] = sum[0][h] + sum[1][h];
}

/// Reflects the columns after the i-th, which is not needed any more. w: A v.
template <int height>
HALYARD_INLINE void reflect(const Reflection& r, const Piece* w, const double* row, Piece* A) {
  Piece u[height];
  _Pragma("GCC unroll 3") for (int h = 0; h < height; ++h) u[h] = r.factor * w[h];
  for (int c = r.i + 1; c < r.columns; ++c) {
    const Piece entry = tiles::all(row[c * r.stride * tiles::kPieceWidth]);
    _Pragma("GCC unroll 3") for (int h = 0; h < height; ++h) A[c * r.stride + h] -= u[h] * entry;
  }
}

void lower_root(int n, int m, int steps, int blocks, Lanes* A, double* L, int l_stride) {
  const int height = pieces_of(n), stride = blocks * kPiecesPerBlock;
  const double* entries = reinterpret_cast<const double*>(A);
  Piece w[kMostRootRows / tiles::kPieceWidth];
  const double* of_w = reinterpret_cast<const double*>(w);
  for (int i = 0; i < steps; ++i) {
    Reflection r{i, m, stride, 0, 0};
    const int first = i / tiles::kPieceWidth;
    from_the_end(
        first,
        height, [&]<int h>(int p) __attribute__((always_inline)) { project<h>(r, pieces(A) + p, entries + i, w + p); });
    const Piece* pivot = pieces(A) + i * stride;
    const double* of_pivot = reinterpret_cast<const double*>(pivot);
    const double norm = __builtin_sqrt(of_w[i]), per_norm = 1 / norm,
                 size = of_pivot[i] > 0 ? of_pivot[i] : -of_pivot[i];
    r.factor = 1 / (norm * (norm + size));
    double* of_L = L + i * l_stride;
    for (int k = 0; k < i; ++k) of_L[k] = 0;
    if (norm == 0) {  // a row of zeros: no reflection
      for (int k = i; k < n; ++k) of_L[k] = of_pivot[k];
      continue;
    }
    for (int k = i; k < n; ++k) of_L[k] = per_norm * of_w[k];
    r.image = of_pivot[i] > 0 ? -norm : norm;
    for (int p = first; p < height; ++p) w[p] -= r.image * pivot[p];
    from_the_end(
        first,
        height, [&]<int h>(int p) __attribute__((always_inline)) { reflect<h>(r, w + p, entries + i, pieces(A) + p); });
  }
}

/// known: the height in registers, or 0 if the compiler is not to know it.
template <int known>
HALYARD_INLINE void squares_of(int height, int columns, const Piece* column, int stride, double* squares) {
  for (int c = 0; c < columns; ++c, column += stride) {
    Piece square = column[0] * column[0];
    for (int p = 1; p < (known > 0 ? known : height); ++p) square += column[p] * column[p];
    squares[c] = sum_of(square);
  }
}

void column_squares(int rows, int columns, const Lanes* A, int blocks, double* squares) {
  const int height = pieces_of(rows), stride = blocks * kPiecesPerBlock;
  if (height == 3) squares_of<3>(height, columns, pieces(A), stride, squares);
  else squares_of<0>(height, columns, pieces(A), stride, squares);
}

void copy(int rows, int columns, const double* A, int a_stride, double* B, int b_stride) {
  constexpr int kWidth = tiles::kPieceWidth;
  for (int c = 0; c < columns; ++c, A += a_stride, B += b_stride) {
    int r = 0;
    for (; r + kWidth <= rows; r += kWidth) {
      Piece entries;
      __builtin_memcpy(&entries, A + r, sizeof(Piece));
      __builtin_memcpy(B + r, &entries, sizeof(Piece));
    }
    for (; r < rows; ++r) B[r] = A[r];
  }
}

/// Transposes square tiles; what is left at the edges, entry by entry.
void transpose(int rows, int columns, const double* A, int a_stride, double* B, int b_stride) {
  constexpr int kWidth = tiles::kPieceWidth;
  const int whole_rows = rows / kWidth * kWidth, whole_columns = columns / kWidth * kWidth;
  for (int c = 0; c < whole_columns; c += kWidth)
    for (int r = 0; r < whole_rows; r += kWidth) {
      Piece tile[kWidth];
      _Pragma("GCC unroll 8") for (int i = 0; i < kWidth; ++i)
          __builtin_memcpy(tile + i, A + r + (c + i) * a_stride, sizeof(Piece));
      tiles::transpose_tile(tile);
      _Pragma("GCC unroll 8") for (int i = 0; i < kWidth; ++i)
          __builtin_memcpy(B + c + (r + i) * b_stride, tile + i, sizeof(Piece));
    }
  for (int c = 0; c < columns; ++c)
    for (int r = c < whole_columns ? whole_rows : 0; r < rows; ++r) B[c + r * b_stride] = A[r + c * a_stride];
}

constexpr MatrixKernels matrix_kernels_named(const char* name) {
  return {name, product, lower_root, column_squares, copy, transpose, phi_functions};
}

}  // namespace
}  // namespace halyard

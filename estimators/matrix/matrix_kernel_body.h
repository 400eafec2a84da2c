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

/// The reflection of a column a, whose entry i becomes `image`: with v = a - image e_i, w -= v (vᵀ w) factor.
struct Reflection {
  int i, first, height, stride;  ///< first, height: the registers that are not zero; stride: registers of a column
  double image, factor;
};

/// Dot products of a with `columns` vectors w.
template <int columns>
HALYARD_INLINE void dot_products(const Reflection& r, const Piece* a, const Piece* w, double* dots) {
  Piece dot[columns];
  _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) dot[c] = a[r.first] * w[c * r.stride + r.first];
  for (int p = r.first + 1; p < r.height; ++p) {
    const Piece entries = a[p];
    _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) dot[c] += entries * w[c * r.stride + p];
  }
  _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) dots[c] = sum_of(dot[c]);
}

template <int columns>
HALYARD_INLINE void reflect(const Reflection& r, const Piece* v, const double* dots, Piece* w) {
  Piece part[columns];
  _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) {
    const double entry = reinterpret_cast<const double*>(w + c * r.stride)[r.i];
    part[c] = tiles::all(r.factor * (dots[c] - r.image * entry));
  }
  for (int p = r.first; p < r.height; ++p) {
    const Piece entries = v[p];
    _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) w[c * r.stride + p] -= entries * part[c];
  }
}

/// f<columns>(j) for the columns from `from` to n, as many at a time as possible.
template <class F>
HALYARD_INLINE void in_tiles(int from, int n, const F& f) {
  int j = from;
  for (; j + 4 <= n; j += 4) f.template operator()<4>(j);
  if (j + 2 <= n) f.template operator()<2>(j), j += 2;
  if (j < n) f.template operator()<1>(j);
}

void lower_root(int n, int m, int steps, int blocks, Lanes* A, double* L, int l_stride) {
  const int height = pieces_of(m), stride = blocks * kPiecesPerBlock, rows = blocks * kLaneWidth;
  double* entries = reinterpret_cast<double*>(A);
  for (int i = 0; i < steps; ++i) {
    Reflection r{i, i / tiles::kPieceWidth, height, stride, 0, 0};
    double *column = entries + i * rows, *of_L = L + i * l_stride, *dots = of_L;
    for (int k = r.first * tiles::kPieceWidth; k < i; ++k) column[k] = 0;  // already in L
    Piece* a = pieces(A) + i * stride;
    in_tiles(
        i, n, [&]<int columns>(int j) __attribute__((always_inline)) {
          dot_products<columns>(r, a, pieces(A) + j * stride, dots + j);
        });
    const double norm = __builtin_sqrt(dots[i]), alpha = column[i];
    r.image = alpha > 0 ? -norm : norm;
    for (int k = 0; k < i; ++k) of_L[k] = 0;
    of_L[i] = norm;
    if (norm != 0) {
      column[i] = alpha - r.image;
      r.factor = 1 / (norm * (norm + (alpha > 0 ? alpha : -alpha)));
      in_tiles(
          i + 1, n, [&]<int columns>(int j) __attribute__((always_inline)) {
            reflect<columns>(r, a, dots + j, pieces(A) + j * stride);
          });
    }
    const double sign = r.image < 0 ? -1 : 1;
    for (int j = i + 1; j < n; ++j) of_L[j] = sign * entries[j * rows + i];
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
  return {name, product, lower_root, column_squares, transpose, phi_functions};
}

}  // namespace
}  // namespace halyard

/// The kernels of matrix_kernels.h, for the instruction set that the including file is compiled for.
/// No include guard: each kernels_<set>.cpp includes it exactly once.

#include "estimators/matrix/phi_kernel_body.h"

namespace halyard {
namespace {

using tiles::Piece, tiles::pieces, tiles::pieces_of, tiles::kPiecesPerBlock, tiles::sum_of;

void product(int rows, int k, int m, const Lanes* A, int a_blocks, const RightFactor& B, Lanes* C, int c_blocks,
             bool add) {
  Piece* out = pieces(C);
  const int c_stride = c_blocks * kPiecesPerBlock, a_stride = a_blocks * kPiecesPerBlock;
  const tiles::Right right{B.data, B.row, B.column};
  if (add) {
    tiles::product(
        pieces_of(rows), k, m, pieces(A), a_stride,
        right, [&](int p, int c, const Piece& sum) __attribute__((always_inline)) { out[p + c * c_stride] += sum; });
  } else {
    tiles::product(
        pieces_of(rows), k, m, pieces(A), a_stride,
        right, [&](int p, int c, const Piece& sum) __attribute__((always_inline)) { out[p + c * c_stride] = sum; });
  }
}

/// w -= v (vᵀ w) factor for `columns` vectors w, from register `first` on; v is zero before.
template <int columns>
HALYARD_INLINE void reflect(int first, int height, int stride, const Piece* v, double factor, Piece* w) {
  Piece dot[columns];
  _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) dot[c] = Piece{};
  for (int p = first; p < height; ++p) {
    const Piece a = v[p];
    _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) dot[c] += a * w[c * stride + p];
  }
  _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) dot[c] = tiles::all(factor * sum_of(dot[c]));
  for (int p = first; p < height; ++p) {
    const Piece a = v[p];
    _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) w[c * stride + p] -= a * dot[c];
  }
}

void lower_root(int n, int m, int steps, int blocks, Lanes* A, double* L, int l_stride) {
  constexpr int kTile = 4;
  const int height = pieces_of(m), stride = blocks * kPiecesPerBlock, rows = blocks * kLaneWidth;
  double* entries = reinterpret_cast<double*>(A);
  for (int i = 0; i < steps; ++i) {
    const int first = i / tiles::kPieceWidth;
    double* column = entries + i * rows;
    for (int r = first * tiles::kPieceWidth; r < i; ++r) column[r] = 0;  // already in L
    Piece* v = pieces(A) + i * stride;
    Piece squares = v[first] * v[first];
    for (int p = first + 1; p < height; ++p) squares += v[p] * v[p];
    const double norm = __builtin_sqrt(sum_of(squares)), alpha = column[i];
    const double image = alpha > 0 ? -norm : norm;  // what becomes of alpha
    double* of_L = L + i * l_stride;
    for (int k = 0; k < i; ++k) of_L[k] = 0;
    of_L[i] = norm;
    if (norm != 0) {
      column[i] = alpha - image;
      const double factor = 1 / (norm * (norm + (alpha > 0 ? alpha : -alpha)));
      int j = i + 1;
      for (; j + kTile <= n; j += kTile) reflect<kTile>(first, height, stride, v, factor, pieces(A) + j * stride);
      for (; j < n; ++j) reflect<1>(first, height, stride, v, factor, pieces(A) + j * stride);
    }
    const double sign = image < 0 ? -1 : 1;
    for (int j = i + 1; j < n; ++j) of_L[j] = sign * entries[j * rows + i];
  }
}

void column_moments(int rows, int columns, const Lanes* A, int blocks, const double* centre, double* sums,
                    double* squares) {
  const int height = pieces_of(rows), stride = blocks * kPiecesPerBlock;
  const Piece* column = pieces(A);
  for (int c = 0; c < columns; ++c, column += stride) {
    Piece sum{}, square{};
    for (int p = 0; p < height; ++p) {
      const Piece difference = column[p] - centre[c];
      sum += difference;
      square += difference * difference;
    }
    sums[c] = sum_of(sum);
    squares[c] = sum_of(square);
  }
}

constexpr MatrixKernels matrix_kernels_named(const char* name) {
  return {name, product, lower_root, column_moments, phi_functions};
}

}  // namespace
}  // namespace halyard

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

/// w -= v (vᵀ w) factor for `columns` vectors w, from block `first` on; v is zero before.
template <int columns>
HALYARD_INLINE void reflect(int first, int blocks, const Lanes* v, double factor, Lanes* w) {
  Lanes dot[columns];
  _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) dot[c] = Lanes(0.0);
  for (int b = first; b < blocks; ++b) {
    const Lanes a = v[b];
    _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) dot[c] += a * w[c * blocks + b];
  }
  _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) dot[c] = Lanes(factor * sum_of(dot[c]));
  for (int b = first; b < blocks; ++b) {
    const Lanes a = v[b];
    _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) w[c * blocks + b] -= a * dot[c];
  }
}

void lower_root(int n, int blocks, Lanes* A, double* L, int l_stride) {
  constexpr int kTile = 4;
  for (int i = 0; i < n; ++i) {
    Lanes* v = A + i * blocks;
    const int first = i / kLaneWidth, lane = i % kLaneWidth;
    for (int k = 0; k < lane; ++k) v[first].set(k, 0.0);  // already in L
    Lanes squares(0.0);
    for (int b = first; b < blocks; ++b) squares += v[b] * v[b];
    const double norm = __builtin_sqrt(sum_of(squares)), alpha = v[first][lane];
    const double image = alpha > 0 ? -norm : norm;  // what becomes of alpha
    for (int k = 0; k < i; ++k) L[k + i * l_stride] = 0;
    L[i + i * l_stride] = norm;
    if (norm != 0) {
      v[first].set(lane, alpha - image);
      const double factor = 1 / (norm * (norm + (alpha > 0 ? alpha : -alpha)));
      int j = i + 1;
      for (; j + kTile <= n; j += kTile) reflect<kTile>(first, blocks, v, factor, A + j * blocks);
      for (; j < n; ++j) reflect<1>(first, blocks, v, factor, A + j * blocks);
    }
    const double sign = image < 0 ? -1 : 1;
    for (int j = i + 1; j < n; ++j) L[j + i * l_stride] = sign * A[j * blocks + first][lane];
  }
}

constexpr MatrixKernels matrix_kernels_named(const char* name) { return {name, product, lower_root, phi_functions}; }

}  // namespace
}  // namespace halyard

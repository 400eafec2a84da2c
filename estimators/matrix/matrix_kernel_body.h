/// The kernels of matrix_kernels.h, for the instruction set that the including file is compiled for.
/// No include guard: each kernels_<set>.cpp includes it exactly once.

#include "estimators/matrix/matrix_kernels.h"

namespace halyard {
namespace {

/// `columns` columns of one block of rows of C += A B.
template <int columns>
HALYARD_INLINE void add_tile(int blocks, int k, const Lanes* A, const double* B, int b_stride, Lanes* C) {
  Lanes sum[columns];
  _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) sum[c] = C[c * blocks];
  for (int l = 0; l < k; ++l) {
    const Lanes a = A[l * blocks];
    _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) sum[c] += a * Lanes(B[l + c * b_stride]);
  }
  _Pragma("GCC unroll 4") for (int c = 0; c < columns; ++c) C[c * blocks] = sum[c];
}

void add_product(int blocks, int k, int m, const Lanes* A, const double* B, int b_stride, Lanes* C) {
  constexpr int kTile = 4;
  int c = 0;
  for (; c + kTile <= m; c += kTile)
    for (int r = 0; r < blocks; ++r) add_tile<kTile>(blocks, k, A + r, B + c * b_stride, b_stride, C + c * blocks + r);
  for (; c < m; ++c)
    for (int r = 0; r < blocks; ++r) add_tile<1>(blocks, k, A + r, B + c * b_stride, b_stride, C + c * blocks + r);
}

HALYARD_INLINE double sum_of(const Lanes& a) {
  static_assert(kLaneWidth == 8);
  return ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7]));
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

constexpr MatrixKernels matrix_kernels_named(const char* name) { return {name, add_product, lower_root}; }

}  // namespace
}  // namespace halyard

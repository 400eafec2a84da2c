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
  const auto with = k == 6    ? product_with<6>
                    : k == 12 ? product_with<12>
                    : k == 15 ? product_with<15>
                    : k == 18 ? product_with<18>
                              : product_with<0>;
  with(rows, k, m, A, a_blocks, B, C, c_blocks, add);
}

constexpr int kMostRootPieces = kMostRootRows / tiles::kPieceWidth;

/// A -= u times row `from`, and then w = A times row `onto`, of `columns` columns. known: the height in registers, or 0
/// if the compiler is not to know it.
template <int known>
HALYARD_INLINE void reflect_of(int height, int from, int onto, int columns, int stride, const Piece* u, Piece* A,
                               Piece* w) {
  const int h = known > 0 ? known : height;
  constexpr int most = known > 0 ? known : kMostRootPieces;
  Piece factor[most], even[most], odd[most];  // sums of w that do not wait for each other
  _Pragma("GCC unroll 6") for (int p = 0; p < h; ++p) factor[p] = u[p], even[p] = odd[p] = Piece{};
  const Piece factor_onto = tiles::all(reinterpret_cast<const double*>(u)[onto]);
  const auto column = [&](Piece * of_A, Piece * sum) __attribute__((always_inline)) {
    const double* entries = reinterpret_cast<const double*>(of_A);
    const Piece entry = tiles::all(entries[from]), next = tiles::all(entries[onto]) - factor_onto * entry;
    _Pragma("GCC unroll 6") for (int p = 0; p < h; ++p) {
      of_A[p] -= factor[p] * entry;
      sum[p] += next * of_A[p];
    }
  };
  int c = 0;
  for (; c + 2 <= columns; c += 2, A += 2 * stride) column(A, even), column(A + stride, odd);
  if (c < columns) column(A, even);
  _Pragma("GCC unroll 6") for (int p = 0; p < h; ++p) w[p] = even[p] + odd[p];
}

/// Calls f<height>() for heights of up to six registers, else f<0>().
template <class F>
HALYARD_INLINE void with_known_height(int height, const F& f) {
  switch (height) {
    case 1: return f.template operator()<1>();
    case 2: return f.template operator()<2>();
    case 3: return f.template operator()<3>();
    case 4: return f.template operator()<4>();
    case 5: return f.template operator()<5>();
    case 6: return f.template operator()<6>();
    default: return f.template operator()<0>();
  }
}

void reflect(int height, int from, int onto, int columns, int stride, const Piece* u, Piece* A, Piece* w) {
  with_known_height(
      height, [&]<int known>()
                  __attribute__((always_inline)) { reflect_of<known>(height, from, onto, columns, stride, u, A, w); });
}

/// B = A, of `rows` numbers, in registers of `width` and less.
template <int width>
HALYARD_INLINE void copy_column(int rows, const double* A, double* B) {
  int r = 0;
  for (; r + width <= rows; r += width) __builtin_memcpy(B + r, A + r, sizeof(double) * width);
  if constexpr (width > 1) copy_column<width / 2>(rows - r, A + r, B + r);
}

/// Column i of L [n]: zeros, and from row i on scale times v.
HALYARD_INLINE void put_column(int n, int i, double scale, const Piece* v, double* L) {
  for (int p = i / tiles::kPieceWidth, height = tiles::pieces_of(n); p < height; ++p) {
    const Piece entries = scale * v[p];
    const int k = p * tiles::kPieceWidth;
    if (k + tiles::kPieceWidth <= n) __builtin_memcpy(L + k, &entries, sizeof(Piece));
    else copy_column<tiles::kPieceWidth / 2>(n - k, reinterpret_cast<const double*>(&entries), L + k);
  }
  for (int k = 0; k < i; ++k) L[k] = 0;
}

/// Reflection i turns row i of A into `image` times a unit vector: with v that row less the image, A -= (A v) vᵀ
/// factor. w: A times row i.
void lower_root(int n, int m, int steps, int blocks, Lanes* A, double* L, int l_stride) {
  const int height = pieces_of(n), stride = blocks * kPiecesPerBlock;
  Piece w[kMostRootPieces], u[kMostRootPieces];
  for (int p = 0; p < height; ++p) u[p] = Piece{};
  reflect(height, 0, 0, m, stride, u, pieces(A), w);
  for (int i = 0; i < steps; ++i) {
    const int first = i / tiles::kPieceWidth, row = i % tiles::kPieceWidth;
    const Piece* pivot = pieces(A) + i * stride;
    const double entry = pivot[first][row], norm = __builtin_sqrt(w[first][row]), size = entry > 0 ? entry : -entry,
                 image = entry > 0 ? -norm : norm;
    const bool is_zero = norm == 0;  // a row of zeros: no reflection
    const double factor = is_zero ? 0 : 1 / (norm * (norm + size));
    put_column(n, i, is_zero ? 1 : 1 / norm, is_zero ? pivot : w, L + i * l_stride);
    if (i + 1 == n) break;
    for (int p = first; p < height; ++p) u[p] = factor * (w[p] - image * pivot[p]);
    reflect(height - first, row, row + 1, m - i - 1, stride, u + first, pieces(A) + (i + 1) * stride + first,
            w + first);
  }
}

/// g = S w / l, and then S -= g wᵀ / (l + 1). known: as of reflect_of().
template <int known>
HALYARD_INLINE void correct_of(int height, int n, int stride, const double* w, double l, Piece* S, Piece* g) {
  const int h = known > 0 ? known : height;
  const double per_l = 1 / l, share = 1 / (l + 1);
  Piece even[known > 0 ? known : kMostRootPieces], odd[known > 0 ? known : kMostRootPieces];
  _Pragma("GCC unroll 6") for (int p = 0; p < h; ++p) even[p] = odd[p] = Piece{};
  int c = 0;
  for (; c + 2 <= n; c += 2) {
    const Piece first = tiles::all(w[c]), second = tiles::all(w[c + 1]);
    _Pragma("GCC unroll 6") for (int p = 0; p < h; ++p) {
      even[p] += first * S[c * stride + p];
      odd[p] += second * S[(c + 1) * stride + p];
    }
  }
  if (c < n) _Pragma("GCC unroll 6") for (int p = 0; p < h; ++p) even[p] += tiles::all(w[c]) * S[c * stride + p];
  _Pragma("GCC unroll 6") for (int p = 0; p < h; ++p) {
    g[p] = per_l * (even[p] + odd[p]);
    even[p] = share * g[p];
  }
  for (c = 0; c < n; ++c) {
    const Piece factor = tiles::all(w[c]);
    _Pragma("GCC unroll 6") for (int p = 0; p < h; ++p) S[c * stride + p] -= even[p] * factor;
  }
}

void correct(int n, int m, int blocks, const double* H, int h_stride, Lanes* S, Lanes* G, double* L, int l_stride) {
  const int height = pieces_of(n), stride = blocks * kPiecesPerBlock, column = blocks * kLaneWidth;
  const double *of_S = reinterpret_cast<const double*>(S), *of_G = reinterpret_cast<const double*>(G);
  double w[kMostRootRows];
  for (int j = 0; j < m; ++j) {
    for (int c = 0; c < n; ++c) w[c] = 0;
    for (int k = 0; k < m; ++k) L[j + k * l_stride] = 0;
    for (int i = 0; i < n; ++i) {
      const double h = H[j + i * h_stride];
      if (h == 0) continue;
      for (int c = 0; c < n; ++c) w[c] += h * of_S[i + c * column];
      for (int k = 0; k < j; ++k) L[j + k * l_stride] += h * of_G[i + k * column];
    }
    double even = 1, odd = 0;  // of wᵀ w + 1: parts that do not wait for each other
    for (int c = 0; c + 1 < n; c += 2) even += w[c] * w[c], odd += w[c + 1] * w[c + 1];
    if (n % 2 == 1) even += w[n - 1] * w[n - 1];
    const double l = __builtin_sqrt(even + odd);
    L[j + j * l_stride] = l;
    Piece* g = pieces(G) + j * stride;
    with_known_height(
        height, [&]<int known>()
                    __attribute__((always_inline)) { correct_of<known>(height, n, stride, w, l, pieces(S), g); });
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
  with_known_height(
      height, [&]<int known>()
                  __attribute__((always_inline)) { squares_of<known>(height, columns, pieces(A), stride, squares); });
}

void row_squares(int rows, int columns, const Lanes* A, int blocks, double* squares) {
  const Piece* column = pieces(A);
  for (int p = 0, height = pieces_of(rows); p < height; ++p) {
    Piece even{}, odd{};
    int c = 0;
    for (; c + 2 <= columns; c += 2) {
      const Piece *first = column + p + c * blocks * kPiecesPerBlock, *second = first + blocks * kPiecesPerBlock;
      even += *first * *first, odd += *second * *second;
    }
    if (c < columns) even += column[p + c * blocks * kPiecesPerBlock] * column[p + c * blocks * kPiecesPerBlock];
    even += odd;
    const int r = p * tiles::kPieceWidth;
    copy_column<tiles::kPieceWidth>(rows - r < tiles::kPieceWidth ? rows - r : tiles::kPieceWidth,
                                    reinterpret_cast<const double*>(&even), squares + r);
  }
}

void copy(int rows, int columns, const double* A, int a_stride, double* B, int b_stride) {
  for (int c = 0; c < columns; ++c, A += a_stride, B += b_stride) copy_column<tiles::kPieceWidth>(rows, A, B);
}

/// B = Aᵀ in square tiles of `width`; what is left at the edges, in smaller ones.
template <int width>
HALYARD_INLINE void transpose_in_tiles(int rows, int columns, const double* A, int a_stride, double* B, int b_stride) {
  const int whole_rows = rows / width * width, whole_columns = columns / width * width;
  for (int c = 0; c < whole_columns; c += width)
    for (int r = 0; r < whole_rows; r += width)
      tiles::transpose_tile<width>(A + r + c * a_stride, a_stride, B + c + r * b_stride, b_stride);
  if constexpr (width > 1) {
    transpose_in_tiles<width / 2>(rows - whole_rows, whole_columns, A + whole_rows, a_stride, B + whole_rows * b_stride,
                                  b_stride);
    transpose_in_tiles<width / 2>(rows, columns - whole_columns, A + whole_columns * a_stride, a_stride,
                                  B + whole_columns, b_stride);
  }
}

void transpose(int rows, int columns, const double* A, int a_stride, double* B, int b_stride) {
  transpose_in_tiles<tiles::kPieceWidth>(rows, columns, A, a_stride, B, b_stride);
}

constexpr MatrixKernels matrix_kernels_named(const char* name) {
  return {name, product, lower_root, correct, column_squares, row_squares, copy, transpose, phi_functions};
}

}  // namespace
}  // namespace halyard

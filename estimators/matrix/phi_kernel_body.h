/// The φ functions of phi_functions.h, for the instruction set that the including file is compiled for.
/// No include guard: matrix_kernel_body.h includes it.

#include "estimators/matrix/matrix_kernels.h"
#include "estimators/matrix/product_tiles.h"

namespace halyard {
namespace {

/// Operations on matrices [n x n] in lanes, of which only the first rows are computed: where the last rows of Z are zero, as
/// those of constant states, the others are multiples of rows of the unit matrix. known, known_rows: n and the number of
/// rows, or 0 if the compiler is not to know them.
template <int known, int known_rows>
struct SquareMatrices {
  int n, height, stride;  // height: registers of the rows that are computed; stride: registers of a column

  HALYARD_INLINE SquareMatrices(int size, int rows)
      : n(known > 0 ? known : size),
        height(tiles::pieces_of(known_rows > 0 ? known_rows : rows)),
        stride((n + kLaneWidth - 1) / kLaneWidth * tiles::kPiecesPerBlock) {}

  /// C = finish(i, A B), i the index of a register.
  template <class Finish>
  HALYARD_INLINE void product(const Lanes* A, const Lanes* B, Lanes* C, const Finish& finish) const {
    tiles::Piece* out = tiles::pieces(C);
    const int step = stride;
    tiles::product(
        height, n, n, tiles::pieces(A), stride, {reinterpret_cast<const double*>(B), 1, stride * tiles::kPieceWidth},
        [&](int p, int c, const tiles::Piece& sum)
            __attribute__((always_inline)) { out[p + c * step] = finish(p + c * step, sum); });
  }
  HALYARD_INLINE void scale(Lanes* A, double factor) const {
    tiles::Piece* entries = tiles::pieces(A);
    for (int i = 0; i < n * stride; ++i) entries[i] *= factor;
  }
  /// The 1-norm of the entries times their weights; NaN if an entry is.
  HALYARD_INLINE double norm(const Lanes* A, const Lanes* weight) const {
    const tiles::Piece *column = tiles::pieces(A), *w = tiles::pieces(weight);
    double most = 0;
    for (int c = 0; c < n; ++c, column += stride, w += stride) {
      tiles::Piece sum = lane_math::magnitude(column[0] * w[0]);
      for (int i = 1; i < height; ++i) sum += lane_math::magnitude(column[i] * w[i]);
      const double total = tiles::sum_of(sum);
      most = total <= most ? most : total;
      if (total != total) return total;
    }
    return most;
  }
  /// A, of which all but the diagonal has been computed, becomes A + s I.
  HALYARD_INLINE void add_to_diagonal(Lanes* A, double s) const {
    double* entries = reinterpret_cast<double*>(A);
    const int computed = height * tiles::kPieceWidth, step = stride * tiles::kPieceWidth + 1;
    for (int i = 0; i < n && i < computed; ++i) entries[i * step] += s;
    set_rest(A, s);
  }
  /// The rows that are not computed become those of s I.
  HALYARD_INLINE void set_rest(Lanes* A, double s) const {
    double* entries = reinterpret_cast<double*>(A);
    const int used = tiles::pieces_of(n);
    for (int c = 0; c < n; ++c)
      for (int p = height; p < used; ++p) tiles::pieces(A)[c * stride + p] = tiles::Piece{};
    for (int i = height * tiles::kPieceWidth; i < n; ++i) entries[i * (stride * tiles::kPieceWidth + 1)] = s;
  }
};

/// The φ_k and E of Y, given its square and cube.
template <class Square>
HALYARD_INLINE void polynomials(const Square& square, const PhiMemory& m, const PhiLevelMemory& level) {
  using tiles::Piece;
  const Piece *Y = tiles::pieces(m.Y), *Y2 = tiles::pieces(m.Y2);
  const auto same = [](int, const Piece& sum) __attribute__((always_inline)) { return sum; };
  // 1 / k! of k = 3 to 14, by Horner's scheme in Y³.
  Piece* next = tiles::pieces(m.next);
  for (int i = 0; i < square.n * square.stride; ++i) next[i] = (1.0 / 6227020800) * Y[i] + (1.0 / 87178291200) * Y2[i];
  square.add_to_diagonal(m.next, 1.0 / 479001600);
  square.product(
      m.Y3, m.next, m.phi_3, [&](int i, const Piece& sum) __attribute__((always_inline)) {
        return sum + (1.0 / 3628800) * Y[i] + (1.0 / 39916800) * Y2[i];
      });
  square.add_to_diagonal(m.phi_3, 1.0 / 362880);
  square.product(
      m.Y3, m.phi_3, level.E, [&](int i, const Piece& sum) __attribute__((always_inline)) {
        return sum + (1.0 / 5040) * Y[i] + (1.0 / 40320) * Y2[i];
      });
  square.add_to_diagonal(level.E, 1.0 / 720);
  square.product(
      m.Y3, level.E, m.phi_3, [&](int i, const Piece& sum) __attribute__((always_inline)) {
        return sum + (1.0 / 24) * Y[i] + (1.0 / 120) * Y2[i];
      });
  square.add_to_diagonal(m.phi_3, 1.0 / 6);
  square.product(m.Y, m.phi_3, level.phi_2, same);
  square.add_to_diagonal(level.phi_2, 0.5);
  square.product(m.Y, level.phi_2, level.phi_1, same);
  square.add_to_diagonal(level.phi_1, 1);
  square.product(m.Y, level.phi_1, level.E, same);
  square.add_to_diagonal(level.E, 1);
}

/// E, φ_2 and, if wanted, φ_1 of the whole argument.
template <class Square>
HALYARD_INLINE void double_argument(const Square& square, const PhiLevelMemory& half, const PhiLevelMemory& whole,
                                    bool with_phi_1) {
  using tiles::Piece;
  const Piece *one = tiles::pieces(half.phi_1), *two = tiles::pieces(half.phi_2);
  square.product(
      half.E, half.phi_2, whole.phi_2, [&](int i, const Piece& sum) __attribute__((always_inline)) {
        return 0.25 * (sum + one[i] + two[i]);
      });
  if (with_phi_1)
    square.product(
        half.E, half.phi_1,
        whole.phi_1, [&](int i, const Piece& sum) __attribute__((always_inline)) { return 0.5 * (sum + one[i]); });
  square.product(
      half.E, half.E, whole.E, [](int, const Piece& sum) __attribute__((always_inline)) { return sum; });
  square.set_rest(whole.phi_2, 0.5);
  square.set_rest(whole.phi_1, 1);
  square.set_rest(whole.E, 1);
}

/// The least s with (a / 2^s)^2 and (b / 2^s)^3 below θ, from the norms a² and b³ of Y² and Y³; at least 1, and
/// most + 1 if `most` is not enough.
HALYARD_INLINE int count_doublings(double square_norm, double cube_norm, int most) {
  constexpr double kTheta = 1;
  int doublings = 1;
  double square = square_norm / 4, cube = cube_norm / 8;
  while (doublings <= most && !(square < kTheta * kTheta && cube < kTheta * kTheta * kTheta))
    ++doublings, square /= 4, cube /= 8;
  return doublings;
}

template <int known, int known_rows>
int phi_functions_of(int n, int rows, int most, const PhiMemory& m) {
  const SquareMatrices<known, known_rows> square(n, rows);
  const auto same = [](int, const tiles::Piece& sum) __attribute__((always_inline)) { return sum; };
  square.product(m.Y, m.Y, m.Y2, same);
  square.set_rest(m.Y2, 0);
  square.product(m.Y2, m.Y, m.Y3, same);
  square.set_rest(m.Y3, 0);
  const int doublings = count_doublings(square.norm(m.Y2, m.weight), square.norm(m.Y3, m.weight), most);
  if (doublings > most) return -1;
  const double part = 1.0 / static_cast<double>(1LL << doublings);
  square.scale(m.Y, part);
  square.scale(m.Y2, part * part);
  square.scale(m.Y3, part * part * part);
  polynomials(square, m, m.level[doublings]);
  for (int k = doublings; k-- > 0;) double_argument(square, m.level[k + 1], m.level[k], k > 0);
  return doublings;
}

/// Without the last rows that are zero.
HALYARD_INLINE int rows_in_use(int n, const Lanes* A) {
  const double* entries = reinterpret_cast<const double*>(A);
  const int stride = (n + kLaneWidth - 1) / kLaneWidth * kLaneWidth;
  for (int rows = n; rows > 1; --rows)
    for (int c = 0; c < n; ++c)
      if (entries[rows - 1 + c * stride] != 0) return rows;
  return 1;
}

/// Arms of three joints, without unknown constants or with one or two of each joint, have copies of their own, in which the
/// compiler knows the loops.
int phi_functions(int n, int most, const PhiMemory& m) {
  const int rows = rows_in_use(n, m.Y);
  if (n == 12) return phi_functions_of<12, 12>(n, rows, most, m);
  if (n == 15 && rows == 12) return phi_functions_of<15, 12>(n, rows, most, m);
  if (n == 18 && rows == 12) return phi_functions_of<18, 12>(n, rows, most, m);
  return phi_functions_of<0, 0>(n, rows, most, m);
}

}  // namespace
}  // namespace halyard

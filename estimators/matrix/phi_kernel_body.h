/// The φ functions of phi_functions.h, for the instruction set that the including file is compiled for.
/// No include guard: matrix_kernel_body.h includes it.

#include "estimators/matrix/matrix_kernels.h"
#include "estimators/matrix/product_tiles.h"

namespace halyard {
namespace {

/// Operations on the parts of PhiShape. known_n, known_first, known_end: the shape, or 0 if the compiler is not to know
/// it.
template <int known_n, int known_first, int known_end>
struct PhiOperations {
  using Piece = tiles::Piece;
  static constexpr bool known = known_n > 0;
  int n, first, end, count;
  int height, stride;  // registers of the rows below `end`, and of a column
  int moving;          // the first register that has a row from `first` on

  HALYARD_INLINE explicit PhiOperations(const PhiShape& shape)
      : n(known ? known_n : shape.n),
        first(known ? known_first : shape.first),
        end(known ? known_end : shape.end),
        count(end - first),
        height(tiles::pieces_of(end)),
        stride((n + kLaneWidth - 1) / kLaneWidth * tiles::kPiecesPerBlock),
        moving(first / tiles::kPieceWidth) {}

  HALYARD_INLINE double* entries(Lanes* A) const { return reinterpret_cast<double*>(A); }
  HALYARD_INLINE const double* entries(const Lanes* A) const { return reinterpret_cast<const double*>(A); }
  HALYARD_INLINE int column_size() const { return stride * tiles::kPieceWidth; }
  HALYARD_INLINE Lanes* columns_from(Lanes* A, int c) const { return A + c * (stride / tiles::kPiecesPerBlock); }

  /// C = finish(i, A B) in the registers i of rows from register `from` on; A [end x k], B [k x columns].
  template <class Finish>
  HALYARD_INLINE void product(int from, const Lanes* A, int k, const double* B, int columns, Lanes* C,
                              const Finish& finish) const {
    Piece* out = tiles::pieces(C);
    const int step = stride;
    tiles::product(
        height - from, k, columns, tiles::pieces(A) + from, stride,
        {B, 1, column_size()}, [&](int p, int c, const Piece& sum) __attribute__((always_inline)) {
          const int i = from + p + c * step;
          out[i] = finish(i, sum);
        });
  }
  /// The kinematic rows of C: y times the rows of B from `first` on.
  HALYARD_INLINE void set_kinematic_rows(double y, const Lanes* B, int columns, Lanes* C) const {
    const double* from = entries(B) + first;
    double* to = entries(C);
    for (int c = 0; c < columns; ++c, from += column_size(), to += column_size())
      for (int i = 0; i < first; ++i) to[i] = y * from[i];
  }
  /// Adds s to the ones of the unit matrix's columns from `first` on.
  HALYARD_INLINE void add_units(Lanes* C, double s) const {
    for (int i = 0; i < count; ++i) entries(C)[first + i * (column_size() + 1)] += s;
  }
  /// C = A Y in the moving rows and the columns below `end`. Of Y, its moving rows are needed, and y.
  HALYARD_INLINE void times_Y(Lanes* A, const Lanes* Y, double y, Lanes* C) const {
    const auto same = [](int, const Piece& sum) __attribute__((always_inline)) { return sum; };
    const Piece* of_A = tiles::pieces(A);
    const auto with_y = [&](int i, const Piece& sum) __attribute__((always_inline)) { return sum + y * of_A[i]; };
    const Lanes* moved = columns_from(A, first);
    const double* rows = entries(Y) + first;
    product(moving, moved, count, rows, first, C, same);
    product(moving, moved, count, rows + first * column_size(), first, columns_from(C, first), with_y);
    product(moving, moved, count, rows + 2 * first * column_size(), end - 2 * first, columns_from(C, 2 * first), same);
  }
  /// The 1-norm of the entries times their weights; NaN if an entry is.
  HALYARD_INLINE double norm(const Lanes* A, const Lanes* weight) const {
    const Piece *column = tiles::pieces(A), *w = tiles::pieces(weight);
    double most = 0;
    for (int c = 0; c < end; ++c, column += stride, w += stride) {
      Piece sum = lane_math::magnitude(column[0] * w[0]);
      for (int i = 1; i < height; ++i) sum += lane_math::magnitude(column[i] * w[i]);
      const double total = tiles::sum_of(sum);
      most = total <= most ? most : total;
      if (total != total) return total;
    }
    return most;
  }
  /// E = I + φ_1 Z in the columns that E V does not have, with Z = factor Y.
  HALYARD_INLINE void set_other_columns(const Lanes* Y, double factor, const Lanes* phi_1, Lanes* E) const {
    const auto scaled = [&](int, const Piece& sum) __attribute__((always_inline)) { return factor * sum; };
    product(0, phi_1, count, entries(Y) + first, first, E, scaled);
    product(0, phi_1, count, entries(Y) + end * column_size() + first, n - end, columns_from(E, end), scaled);
    for (int i = 0; i < first; ++i) entries(E)[i * (column_size() + 1)] += 1;
    for (int i = end; i < n; ++i) entries(E)[i * (column_size() + 1)] = 1;
  }
};

/// The functions of s Y, given the square and cube of Y.
template <class Operations>
HALYARD_INLINE void polynomials(const Operations& on, const PhiMemory& m, double s, const PhiLevelMemory& level) {
  using tiles::Piece;
  const double s2 = s * s, s3 = s2 * s;
  Lanes *YV = on.columns_from(m.Y, on.first), *EV = on.columns_from(level.E, on.first);
  const Piece *Y = tiles::pieces(YV), *Y2 = tiles::pieces(on.columns_from(m.Y2, on.first));
  const auto scaled = [&](int, const Piece& sum) __attribute__((always_inline)) { return s * sum; };
  // 1 / k! of k = 3 to 14, by Horner's scheme in Y³.
  Piece* next = tiles::pieces(m.next);
  for (int i = 0; i < on.count * on.stride; ++i) next[i] = (s / 6227020800) * Y[i] + (s2 / 87178291200) * Y2[i];
  on.add_units(m.next, 1.0 / 479001600);
  const auto times_Y3 = [&](const Lanes* from, double of_Y, double of_Y2, Lanes* to) __attribute__((always_inline)) {
    const double a = s * of_Y, b = s2 * of_Y2;
    on.product(
        0, m.Y3, on.end, on.entries(from), on.count,
        to, [&](int i, const Piece& sum) __attribute__((always_inline)) { return s3 * sum + a * Y[i] + b * Y2[i]; });
  };
  times_Y3(m.next, 1.0 / 3628800, 1.0 / 39916800, level.phi_3);
  on.add_units(level.phi_3, 1.0 / 362880);
  times_Y3(level.phi_3, 1.0 / 5040, 1.0 / 40320, m.next);
  on.add_units(m.next, 1.0 / 720);
  times_Y3(m.next, 1.0 / 24, 1.0 / 120, level.phi_3);
  on.add_units(level.phi_3, 1.0 / 6);
  const double y = on.first > 0 ? s * on.entries(YV)[0] : 0;
  const Lanes* before = level.phi_3;
  double unit = 0.5;
  for (Lanes* const C : {level.phi_2, level.phi_1, EV}) {
    on.product(on.moving, m.Y, on.end, on.entries(before), on.count, C, scaled);
    on.add_units(C, unit);
    on.set_kinematic_rows(y, before, on.count, C);
    before = C, unit = 1;
  }
  on.set_other_columns(m.Y, s, level.phi_1, level.E);
}

/// The functions of the whole argument, factor Y, from those of its half.
template <class Operations>
HALYARD_INLINE void double_argument(const Operations& on, const PhiMemory& m, double factor, const PhiLevelMemory& half,
                                    const PhiLevelMemory& whole) {
  using tiles::Piece;
  const Piece *one = tiles::pieces(half.phi_1), *two = tiles::pieces(half.phi_2), *three = tiles::pieces(half.phi_3);
  const double y = on.first > 0 ? factor * on.entries(m.Y)[on.first * on.column_size()] : 0;
  Lanes *half_EV = on.columns_from(half.E, on.first), *EV = on.columns_from(whole.E, on.first);
  on.product(
      0, half.E, on.end, on.entries(half.phi_3), on.count,
      whole.phi_3, [&](int i, const Piece& sum) __attribute__((always_inline)) {
        return 0.125 * (sum + 0.5 * one[i] + two[i] + three[i]);
      });
  on.product(
      0, half.E, on.end, on.entries(half.phi_2), on.count,
      whole.phi_2, [&](int i, const Piece& sum) __attribute__((always_inline)) {
        return 0.25 * (sum + one[i] + two[i]);
      });
  on.product(
      on.moving, half.E, on.end, on.entries(half.phi_1), on.count,
      whole.phi_1, [&](int i, const Piece& sum) __attribute__((always_inline)) { return 0.5 * (sum + one[i]); });
  on.set_kinematic_rows(y, whole.phi_2, on.count, whole.phi_1);
  on.product(
      on.moving, half.E, on.end, on.entries(half_EV), on.count, EV,
      [](int, const Piece& sum) __attribute__((always_inline)) { return sum; });
  on.set_kinematic_rows(y, whole.phi_1, on.count, EV);
  on.set_other_columns(m.Y, factor, whole.phi_1, whole.E);
}

/// The least s with (a / 2^s)^2 and (b / 2^s)^3 below θ, from the norms a² and b³ of Y² and Y³; at least 1, and
/// most + 1 if `most` is not enough.
HALYARD_INLINE int count_doublings(double square_norm, double cube_norm, int most) {
  constexpr double kTheta = 2;
  int doublings = 1;
  double square = square_norm / 4, cube = cube_norm / 8;
  while (doublings <= most && !(square < kTheta * kTheta && cube < kTheta * kTheta * kTheta))
    ++doublings, square /= 4, cube /= 8;
  return doublings;
}

template <int known_n, int known_first, int known_end>
int phi_functions_of(const PhiShape& shape, int most, const PhiMemory& m) {
  const PhiOperations<known_n, known_first, known_end> on(shape);
  const double y = on.first > 0 ? on.entries(m.Y)[on.first * on.column_size()] : 0;
  on.times_Y(m.Y, m.Y, y, m.Y2);
  on.set_kinematic_rows(y, m.Y, on.end, m.Y2);
  on.times_Y(m.Y2, m.Y, y, m.Y3);
  on.set_kinematic_rows(y, m.Y2, on.end, m.Y3);
  const int doublings = count_doublings(on.norm(m.Y2, m.weight), on.norm(m.Y3, m.weight), most);
  if (doublings > most) return -1;
  double factor = 1.0 / static_cast<double>(1LL << doublings);
  polynomials(on, m, factor, m.level[doublings]);
  for (int k = doublings; k-- > 0;) {
    factor *= 2;
    double_argument(on, m, factor, m.level[k + 1], m.level[k]);
  }
  return doublings;
}

/// Arms of three joints, without unknown constants or with one or two of each joint, and of seven joints have copies of
/// their own, in which the compiler knows the loops.
int phi_functions(const PhiShape& shape, int most, const PhiMemory& m) {
  const auto is = [&](int n, int first, int end) { return shape.n == n && shape.first == first && shape.end == end; };
  if (is(12, 6, 12)) return phi_functions_of<12, 6, 12>(shape, most, m);
  if (is(15, 6, 12)) return phi_functions_of<15, 6, 12>(shape, most, m);
  if (is(18, 6, 12)) return phi_functions_of<18, 6, 12>(shape, most, m);
  if (is(28, 14, 28)) return phi_functions_of<28, 14, 28>(shape, most, m);
  return phi_functions_of<0, 0, 0>(shape, most, m);
}

}  // namespace
}  // namespace halyard

#pragma once
/// A value with kLaneWidth directional derivatives, for the rigid chain only: it has no divisions and functions but
/// those that the chain needs. Parameters stay plain numbers, which have no slopes.

#include "transmission/scalar.h"

namespace halyard {

/// a + Σ d_i ε_i with ε_i ε_j = 0.
struct Slopes {
  double a;
  Lanes d;

  HALYARD_INLINE Slopes() = default;
  HALYARD_INLINE Slopes(double value) : a(value), d(0.0) {}  // NOLINT: a constant is a scalar too
  HALYARD_INLINE Slopes(double value, const Lanes& slopes) : a(value), d(slopes) {}

  HALYARD_INLINE Slopes& operator+=(const Slopes& y) {
    a += y.a;
    d += y.d;
    return *this;
  }
  HALYARD_INLINE Slopes& operator-=(const Slopes& y) {
    a -= y.a;
    d -= y.d;
    return *this;
  }
};

HALYARD_INLINE Slopes operator+(Slopes x, const Slopes& y) { return x += y; }
HALYARD_INLINE Slopes operator-(Slopes x, const Slopes& y) { return x -= y; }
HALYARD_INLINE Slopes operator-(const Slopes& x) { return {-x.a, -x.d}; }
HALYARD_INLINE Slopes operator*(const Slopes& x, const Slopes& y) {
  return {x.a * y.a, x.d * Lanes(y.a) + y.d * Lanes(x.a)};
}
HALYARD_INLINE Slopes operator*(double x, const Slopes& y) { return {x * y.a, y.d * Lanes(x)}; }
HALYARD_INLINE Slopes operator*(const Slopes& x, double y) { return y * x; }
HALYARD_INLINE void sin_cos(const Slopes& x, Slopes& sine, Slopes& cosine) {
  const double s = std::sin(x.a), c = std::cos(x.a);
  sine = {s, x.d * Lanes(c)};
  cosine = {c, x.d * Lanes(-s)};
}

}  // namespace halyard

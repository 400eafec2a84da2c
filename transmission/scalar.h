#pragma once
/// Scalar types of the arm's equations.
///
///   double   one value
///   Dual     value and kDualWidth directional derivatives: exact Jacobians
///   Lanes    kLaneWidth values side by side in vector registers: many sigma points, or many
///            parameter sets, in little more time than one
///
/// Code over a scalar T branches with select(condition, a, b) and uses min, max, abs, tanh, exp, sinh, sin, cos,
/// sin_cos, sqrt, log of this header. A library's automatic differentiation type cannot replace Dual: its expression
/// templates cannot be arguments of a virtual function, and they have no lanes.

#include <cmath>
#include <cstddef>

#include "transmission/packed.h"

namespace halyard {

inline constexpr int kLaneWidth = 8;
inline constexpr int kDualWidth = 4;

// ------------------------------------------------------------------------------------- Lanes

using LaneMask = PackedMask<kLaneWidth, kRegisterWidth>;

struct Lanes {
  using Vector = Packed<kLaneWidth, kRegisterWidth>;
  Vector v;

  HALYARD_INLINE Lanes() = default;
  HALYARD_INLINE Lanes(double s) : v(s) {}  // NOLINT: a constant is a scalar too
  HALYARD_INLINE explicit Lanes(const Vector& values) : v(values) {}
  HALYARD_INLINE double operator[](int i) const { return v[i]; }
  HALYARD_INLINE void set(int i, double s) { v.set(i, s); }

  HALYARD_INLINE Lanes& operator+=(const Lanes& b) {
    v += b.v;
    return *this;
  }
  HALYARD_INLINE Lanes& operator-=(const Lanes& b) {
    v -= b.v;
    return *this;
  }
  HALYARD_INLINE Lanes& operator*=(const Lanes& b) {
    v *= b.v;
    return *this;
  }
  HALYARD_INLINE Lanes& operator/=(const Lanes& b) {
    v /= b.v;
    return *this;
  }
};

HALYARD_INLINE Lanes operator+(Lanes a, const Lanes& b) { return a += b; }
HALYARD_INLINE Lanes operator-(Lanes a, const Lanes& b) { return a -= b; }
HALYARD_INLINE Lanes operator*(Lanes a, const Lanes& b) { return a *= b; }
HALYARD_INLINE Lanes operator/(Lanes a, const Lanes& b) { return a /= b; }
HALYARD_INLINE Lanes operator-(const Lanes& a) { return Lanes(-a.v); }
HALYARD_INLINE LaneMask operator<(const Lanes& a, const Lanes& b) { return LaneMask::less(a.v, b.v); }
HALYARD_INLINE LaneMask operator>(const Lanes& a, const Lanes& b) { return LaneMask::less(b.v, a.v); }
HALYARD_INLINE LaneMask operator<=(const Lanes& a, const Lanes& b) { return LaneMask::less_or_equal(a.v, b.v); }
HALYARD_INLINE LaneMask operator>=(const Lanes& a, const Lanes& b) { return LaneMask::less_or_equal(b.v, a.v); }
HALYARD_INLINE LaneMask operator&&(LaneMask a, const LaneMask& b) { return a &= b; }
HALYARD_INLINE LaneMask operator||(LaneMask a, const LaneMask& b) { return a |= b; }
HALYARD_INLINE Lanes select(const LaneMask& c, const Lanes& a, const Lanes& b) { return Lanes(c.choose(a.v, b.v)); }

#define HALYARD_LANE_FUNCTION(name)                                                                  \
  HALYARD_INLINE Lanes name(const Lanes& a) {                                                        \
    using V = Lanes::Vector;                                                                         \
    return Lanes(a.v.each([](const V::Piece& x) { return lane_math::name<V::Piece, V::Bits>(x); })); \
  }
HALYARD_LANE_FUNCTION(tanh)
HALYARD_LANE_FUNCTION(exp)
HALYARD_LANE_FUNCTION(sinh)
#undef HALYARD_LANE_FUNCTION

HALYARD_INLINE void sin_cos(const Lanes& a, Lanes& sine, Lanes& cosine) {
  using V = Lanes::Vector;
  for (int i = 0; i < V::kPieces; ++i) {
    const auto both = lane_math::sine_and_cosine<V::Piece, V::Bits>(a.v.piece[i]);
    sine.v.piece[i] = both.sine;
    cosine.v.piece[i] = both.cosine;
  }
}
HALYARD_INLINE Lanes sin(const Lanes& a) {
  Lanes sine, cosine;
  sin_cos(a, sine, cosine);
  return sine;
}
HALYARD_INLINE Lanes cos(const Lanes& a) {
  Lanes sine, cosine;
  sin_cos(a, sine, cosine);
  return cosine;
}

HALYARD_INLINE Lanes log(Lanes a) {
  for (int i = 0; i < kLaneWidth; ++i) a.set(i, std::log(a[i]));
  return a;
}
HALYARD_INLINE Lanes sqrt(Lanes a) {
  for (int i = 0; i < kLaneWidth; ++i) a.set(i, __builtin_sqrt(a[i]));
  return a;
}

// -------------------------------------------------------------------------------------- Dual

/// A cable's stretch is small, and a library's function costs three times the series.
HALYARD_INLINE double sinh(double x) {
  return std::abs(x) < lane_math::kSeriesEnd ? lane_math::sinh_series(x) : std::sinh(x);
}

/// a + b eps with eps² = 0, for kDualWidth directions at once.
struct Dual {
  using Vector = Packed<kDualWidth, kDualWidth>;
  double a;
  Vector d;

  HALYARD_INLINE Dual() = default;
  HALYARD_INLINE Dual(double value) : a(value), d(0.0) {}  // NOLINT: a constant is a scalar too
  HALYARD_INLINE Dual(double value, const Vector& derivative) : a(value), d(derivative) {}
  HALYARD_INLINE static Dual seed(double value, int direction) {
    Dual x(value);
    x.d.set(direction, 1);
    return x;
  }

  HALYARD_INLINE Dual& operator+=(const Dual& b) {
    a += b.a;
    d += b.d;
    return *this;
  }
  HALYARD_INLINE Dual& operator-=(const Dual& b) {
    a -= b.a;
    d -= b.d;
    return *this;
  }
  HALYARD_INLINE Dual& operator*=(const Dual& b) {
    d = d * b.a + b.d * a;
    a *= b.a;
    return *this;
  }
  HALYARD_INLINE Dual& operator/=(const Dual& b) {
    a /= b.a;
    d = (d - b.d * a) / b.a;
    return *this;
  }
};

HALYARD_INLINE Dual operator+(Dual x, const Dual& y) { return x += y; }
HALYARD_INLINE Dual operator-(Dual x, const Dual& y) { return x -= y; }
HALYARD_INLINE Dual operator*(Dual x, const Dual& y) { return x *= y; }
HALYARD_INLINE Dual operator/(Dual x, const Dual& y) { return x /= y; }
HALYARD_INLINE Dual operator-(Dual x) {
  x.a = -x.a;
  x.d = -x.d;
  return x;
}
HALYARD_INLINE bool operator<(const Dual& x, const Dual& y) { return x.a < y.a; }
HALYARD_INLINE bool operator>(const Dual& x, const Dual& y) { return x.a > y.a; }
HALYARD_INLINE bool operator<=(const Dual& x, const Dual& y) { return x.a <= y.a; }
HALYARD_INLINE bool operator>=(const Dual& x, const Dual& y) { return x.a >= y.a; }
HALYARD_INLINE Dual sin(const Dual& x) { return {std::sin(x.a), x.d * std::cos(x.a)}; }
HALYARD_INLINE Dual cos(const Dual& x) { return {std::cos(x.a), -x.d * std::sin(x.a)}; }
HALYARD_INLINE void sin_cos(const Dual& x, Dual& sine, Dual& cosine) {
  const double s = std::sin(x.a), c = std::cos(x.a);
  sine = {s, x.d * c};
  cosine = {c, -x.d * s};
}
HALYARD_INLINE Dual tanh(const Dual& x) {
  const double t = std::tanh(x.a);
  return {t, x.d * (1 - t * t)};
}
HALYARD_INLINE Dual exp(const Dual& x) {
  const double e = std::exp(x.a);
  return {e, x.d * e};
}
HALYARD_INLINE Dual sinh(const Dual& x) {
  const double s = sinh(x.a);
  return {s, x.d * std::sqrt(1 + s * s)};
}
HALYARD_INLINE Dual log(const Dual& x) { return {std::log(x.a), x.d / x.a}; }
HALYARD_INLINE Dual sqrt(const Dual& x) {
  const double s = std::sqrt(x.a);
  return {s, x.d / (2 * s)};
}

// ------------------------------------------------------------------- functions of all scalars

using std::cos;
using std::exp;
using std::log;
using std::sin;
using std::sqrt;
using std::tanh;

HALYARD_INLINE void sin_cos(double x, double& sine, double& cosine) {
  sine = std::sin(x);
  cosine = std::cos(x);
}
HALYARD_INLINE double select(bool c, double a, double b) { return c ? a : b; }
HALYARD_INLINE Dual select(bool c, const Dual& a, const Dual& b) { return c ? a : b; }

/// True if a condition holds, in all lanes of Lanes. A branch on it must leave each lane's value as it is without the
/// branch, because a lane's value does not depend on the others.
HALYARD_INLINE bool holds(bool condition) { return condition; }
HALYARD_INLINE bool holds(const LaneMask& condition) { return condition.all(); }

template <class T>
HALYARD_INLINE T max(const T& a, const T& b) {
  return select(a > b, a, b);
}
template <class T>
HALYARD_INLINE T min(const T& a, const T& b) {
  return select(a < b, a, b);
}
template <class T>
HALYARD_INLINE T abs(const T& a) {
  return select(a < T(0.0), T(-a), a);
}

/// The plain value: the value of a Dual, lane 0 of Lanes.
HALYARD_INLINE double value(double x) { return x; }
HALYARD_INLINE double value(const Dual& x) { return x.a; }
HALYARD_INLINE double value(const Lanes& x) { return x[0]; }

}  // namespace halyard

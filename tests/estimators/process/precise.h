#pragma once
/// A scalar of long double for the templates over scalar.h: the reference of their values and derivatives in double.

#include <cmath>

#include "transmission/arm_fields.h"

namespace halyard {

struct Precise {
  long double a = 0;

  Precise() = default;
  Precise(double value) : a(value) {}  // NOLINT(google-explicit-constructor): a constant is a scalar too
  static Precise of(long double value) {
    Precise x;
    x.a = value;
    return x;
  }

  Precise& operator+=(const Precise& b) { return a += b.a, *this; }
  Precise& operator-=(const Precise& b) { return a -= b.a, *this; }
  Precise& operator*=(const Precise& b) { return a *= b.a, *this; }
  Precise& operator/=(const Precise& b) { return a /= b.a, *this; }
};

inline Precise operator+(Precise x, const Precise& y) { return x += y; }
inline Precise operator-(Precise x, const Precise& y) { return x -= y; }
inline Precise operator*(Precise x, const Precise& y) { return x *= y; }
inline Precise operator/(Precise x, const Precise& y) { return x /= y; }
inline Precise operator-(const Precise& x) { return Precise::of(-x.a); }
inline bool operator<(const Precise& x, const Precise& y) { return x.a < y.a; }
inline bool operator>(const Precise& x, const Precise& y) { return x.a > y.a; }
inline Precise select(bool c, const Precise& x, const Precise& y) { return c ? x : y; }
inline Precise tanh(const Precise& x) { return Precise::of(std::tanh(x.a)); }
inline Precise exp(const Precise& x) { return Precise::of(std::exp(x.a)); }
inline Precise sinh(const Precise& x) { return Precise::of(std::sinh(x.a)); }
inline void sin_cos(const Precise& x, Precise& sine, Precise& cosine) {
  sine.a = std::sin(x.a);
  cosine.a = std::cos(x.a);
}

/// The arm over this scalar; lift() of arm_parameters.h knows the library's scalars alone.
inline ArmParameters<Precise> precise(const ArmParameters<double>& from) {
  ArmParameters<Precise> to;
  const auto copy = [](auto& b, const auto& a) { b = a; };
  for_each_field(
      kMaxJoints, [&](const ArmField&, auto& b, const auto& a) { for_each_entry(copy, b, a); }, to, from);
  return to;
}

}  // namespace halyard

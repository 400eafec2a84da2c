#pragma once
/// exp, tanh, sinh, sin and cos of vectors of doubles, from additions, multiplications, one division at most, and bit
/// operations. They are inlined, so a compiler can overlap the functions of several joints, and give the same kind of
/// code for every instruction set.
///
///   exp(x) - 1 = 2^k p(r) + (2^k - 1)      k = round(x / ln 2),  r = x - k ln 2,  p(r) = Σ_{i=1..13} r^i / i!
///   tanh(x)    = -m / (m + 2)              m = exp(-2 |x|) - 1, with the sign of x; 1 from |x| = 20 on
///   sinh(x)    = (m + m / (m + 1)) / 2     m = exp(|x|) - 1, with the sign of x
///              = x Σ_{i=0..7} x^2i / (2i + 1)!                  for |x| < 1/2
///   sin, cos                               k = round(x 2/π),  r = x - k π/2,  Taylor polynomials of degree 15 and 16
///
/// Error bounds, checked by tests: relative 4 ε for exp, tanh and sinh (ε = 2^-52); absolute 2 ε for sin and cos of
/// |x| < 1e5. Larger angles lose digits in proportion; beyond 1e9 the result means nothing. The argument of exp and
/// sinh is limited to ±708. NaN stays NaN.
///
/// Friction is mostly saturated and a cable's stretch is small. Where all entries are, the exponential function is left
/// out. The result of an entry does not depend on the others.
///
/// The constants of r are split in parts, so that k times the first part is exact. Source: Cody and Waite, Software
/// Manual for the Elementary Functions, 1980.

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#define HALYARD_INLINE inline __attribute__((always_inline))

namespace halyard::lane_math {

/// Nearest integer: as a number, and in the low bits of `bits`.
template <class V, class I>
struct Rounded {
  V number;
  I bits;
};

template <class V, class I>
HALYARD_INLINE Rounded<V, I> round_to_integer(const V& x) {
  constexpr double kMagic = 0x1.8p52;  // its last bit is worth 1
  const V shifted = x + kMagic;
  return {shifted - kMagic, (I)shifted};
}

/// Σ_{i=1..13} r^i / i! for |r| <= ln 2 / 2.
template <class V>
HALYARD_INLINE V expm1_polynomial(const V& r) {
  const V r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
  const V a = (1.0 / 2 + r * (1.0 / 6)) + r2 * (1.0 / 24 + r * (1.0 / 120));
  const V b = (1.0 / 720 + r * (1.0 / 5040)) + r2 * (1.0 / 40320 + r * (1.0 / 362880));
  const V c = (1.0 / 3628800 + r * (1.0 / 39916800)) + r2 * (1.0 / 479001600 + r * (1.0 / 6227020800));
  return r + r2 * (a + r4 * b + r8 * c);
}

/// 2^k and p(r) of an argument within ±708.
template <class V>
struct ReducedExp {
  V scale, p;
};

template <class V, class I>
HALYARD_INLINE ReducedExp<V> reduced_exp(const V& x) {
  constexpr double kPerLn2 = 1.4426950408889634, kLn2High = 0x1.62e42fee00000p-1, kLn2Low = 0x1.a39ef35793c76p-33;
  constexpr int kFractionBits = 52, kExponentBias = 1023;
  const Rounded<V, I> k = round_to_integer<V, I>(x * kPerLn2);
  const V r = (x - k.number * kLn2High) - k.number * kLn2Low;
  return {(V)((k.bits + kExponentBias) << kFractionBits), expm1_polynomial(r)};
}

/// x within ±708; NaN stays NaN.
template <class V>
HALYARD_INLINE V bounded(const V& x) {
  constexpr double kMost = 708;
  const V below = x > kMost ? V{} + kMost : x;
  return below < -kMost ? V{} - kMost : below;
}

inline constexpr long long kSignBit = -0x7fffffffffffffffLL - 1;

template <class V>
HALYARD_INLINE V magnitude(const V& x) {
  using I = decltype(x < x);
  return (V)((I)x & ~kSignBit);
}

/// `size`, which is not negative, with the sign of x.
template <class V>
HALYARD_INLINE V with_sign_of(const V& x, const V& size) {
  using I = decltype(x < x);
  return (V)((I)size | ((I)x & kSignBit));
}

/// True if all bits of all entries are set, where an entry has either all or none.
template <class I>
HALYARD_INLINE bool all(const I& entries) {
#if defined(__AVX512DQ__)
  if constexpr (sizeof(I) == 64) return _mm512_movepi64_mask((__m512i)entries) == 0xff;
#endif
#if defined(__AVX__)
  if constexpr (sizeof(I) == 32) return _mm256_movemask_pd((__m256d)entries) == 0xf;
#endif
#if defined(__SSE2__)
  if constexpr (sizeof(I) == 16) return _mm_movemask_pd((__m128d)entries) == 0x3;
#endif
  bool set = true;
  for (unsigned i = 0; i < sizeof(I) / 8; ++i) set &= entries[i] != 0;
  return set;
}

template <class V, class I>
HALYARD_INLINE V exp(const V& x) {
  const ReducedExp<V> e = reduced_exp<V, I>(bounded(x));
  return e.scale + e.scale * e.p;
}

/// x within ±708.
template <class V, class I>
HALYARD_INLINE V expm1(const V& x) {
  const ReducedExp<V> e = reduced_exp<V, I>(x);
  return e.scale * e.p + (e.scale - 1.0);
}

template <class V, class I>
HALYARD_INLINE V tanh(const V& x) {
  constexpr double kSaturated = 20;  // exp(-2 |x|) < ε / 2 already from 18.4 on
  const V size = magnitude(x);
  if (all(size >= kSaturated)) return with_sign_of<V>(x, V{} + 1.0);
  const V m = expm1<V, I>(bounded<V>(-2.0 * size));
  return with_sign_of<V>(x, magnitude<V>(m / (m + 2.0)));
}

/// sinh(x) for |x| < kSeriesEnd.
inline constexpr double kSeriesEnd = 0.5;
template <class V>
HALYARD_INLINE V sinh_series(const V& x) {
  const V r2 = x * x, r4 = r2 * r2;
  const V a = (1.0 / 6 + r2 * (1.0 / 120)) + r4 * (1.0 / 5040 + r2 * (1.0 / 362880));
  const V b = (1.0 / 39916800 + r2 * (1.0 / 6227020800)) + r4 * (1.0 / 1307674368000);
  return x + x * r2 * (a + r4 * r4 * b);
}

template <class V, class I>
HALYARD_INLINE V sinh(const V& x) {
  const V size = magnitude(x), near = sinh_series(x);
  const I is_near = size < kSeriesEnd;
  if (all(is_near)) return near;
  const V m = expm1<V, I>(bounded(size));
  return is_near != 0 ? near : with_sign_of<V>(x, 0.5 * (m + m / (m + 1.0)));
}

template <class V>
struct SineAndCosine {
  V sine, cosine;
};

template <class V, class I>
HALYARD_INLINE SineAndCosine<V> sine_and_cosine(const V& x) {
  constexpr double kPerRightAngle = 0.63661977236758134;
  constexpr double kHigh = 0x1.921fb544p0, kMiddle = 0x1.0b4611a6p-34, kLow = 0x1.3198a2e037073p-69;
  const Rounded<V, I> k = round_to_integer<V, I>(x * kPerRightAngle);
  const V r = ((x - k.number * kHigh) - k.number * kMiddle) - k.number * kLow;
  const V r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
  const V s = (-1.0 / 6 + r2 * (1.0 / 120)) + r4 * (-1.0 / 5040 + r2 * (1.0 / 362880)) +
              r8 * ((-1.0 / 39916800 + r2 * (1.0 / 6227020800)) + r4 * (-1.0 / 1307674368000));
  const V c = (1.0 / 24 + r2 * (-1.0 / 720)) + r4 * (1.0 / 40320 + r2 * (-1.0 / 3628800)) +
              r8 * ((1.0 / 479001600 + r2 * (-1.0 / 87178291200)) + r4 * (1.0 / 20922789888000));
  const V sine = r + r * r2 * s, cosine = (1.0 - 0.5 * r2) + r4 * c;
  const I quadrant = k.bits & 3;
  const V first = (quadrant & 1) != 0 ? cosine : sine, second = (quadrant & 1) != 0 ? sine : cosine;
  return {(quadrant & 2) != 0 ? -first : first, ((quadrant + 1) & 2) != 0 ? -second : second};
}

}  // namespace halyard::lane_math

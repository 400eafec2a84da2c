#pragma once
/// n doubles that are calculated with side by side, in pieces of `width`. GCC keeps vectors that are wider than a
/// register in memory, so code that has to be fast takes pieces as wide as the registers of the instruction set that a
/// file is compiled for. Size and alignment, 8 n bytes, do not depend on the width, so files compiled for different
/// sets can exchange them.
///
/// The operations are forced inline. Otherwise a file compiled for a wider instruction set would leave copies of them,
/// and other files might call these copies.

#include "transmission/lane_math.h"

namespace halyard {

#if defined(__AVX512F__)
inline constexpr int kRegisterWidth = 8;
#elif defined(__AVX__)
inline constexpr int kRegisterWidth = 4;
#else
inline constexpr int kRegisterWidth = 2;
#endif

#define HALYARD_EACH_PIECE _Pragma("GCC unroll 8") for (int i = 0; i < kPieces; ++i)

template <int n, int width>
struct alignas(8 * n) Packed {
  static constexpr int kPieces = n / width;
  typedef double Piece __attribute__((vector_size(8 * width)));
  typedef long long Bits __attribute__((vector_size(8 * width)));

  Piece piece[kPieces];

  HALYARD_INLINE Packed() = default;
  HALYARD_INLINE Packed(double s) {  // NOLINT: a constant is a scalar too
    HALYARD_EACH_PIECE piece[i] = s - Piece{};
  }
  HALYARD_INLINE double operator[](int k) const { return piece[k / width][k % width]; }
  HALYARD_INLINE void set(int k, double s) { piece[k / width][k % width] = s; }

  HALYARD_INLINE Packed& operator+=(const Packed& b) {
    HALYARD_EACH_PIECE piece[i] += b.piece[i];
    return *this;
  }
  HALYARD_INLINE Packed& operator-=(const Packed& b) {
    HALYARD_EACH_PIECE piece[i] -= b.piece[i];
    return *this;
  }
  HALYARD_INLINE Packed& operator*=(const Packed& b) {
    HALYARD_EACH_PIECE piece[i] *= b.piece[i];
    return *this;
  }
  HALYARD_INLINE Packed& operator/=(const Packed& b) {
    HALYARD_EACH_PIECE piece[i] /= b.piece[i];
    return *this;
  }
  /// f(piece) of each piece.
  template <class F>
  HALYARD_INLINE Packed each(F&& f) const {
    Packed r;
    HALYARD_EACH_PIECE r.piece[i] = f(piece[i]);
    return r;
  }

  friend HALYARD_INLINE Packed operator+(Packed a, const Packed& b) { return a += b; }
  friend HALYARD_INLINE Packed operator-(Packed a, const Packed& b) { return a -= b; }
  friend HALYARD_INLINE Packed operator*(Packed a, const Packed& b) { return a *= b; }
  friend HALYARD_INLINE Packed operator/(Packed a, const Packed& b) { return a /= b; }
  friend HALYARD_INLINE Packed operator-(Packed a) {
    HALYARD_EACH_PIECE a.piece[i] = -a.piece[i];
    return a;
  }
};

/// The results of n comparisons: all bits of an entry are set, or none.
template <int n, int width>
struct alignas(8 * n) PackedMask {
  using Values = Packed<n, width>;
  static constexpr int kPieces = Values::kPieces;
  typename Values::Bits piece[kPieces];

  HALYARD_INLINE PackedMask& operator&=(const PackedMask& b) {
    HALYARD_EACH_PIECE piece[i] &= b.piece[i];
    return *this;
  }
  HALYARD_INLINE PackedMask& operator|=(const PackedMask& b) {
    HALYARD_EACH_PIECE piece[i] |= b.piece[i];
    return *this;
  }

  HALYARD_INLINE static PackedMask less(const Values& a, const Values& b) {
    PackedMask r;
    HALYARD_EACH_PIECE r.piece[i] = a.piece[i] < b.piece[i];
    return r;
  }
  HALYARD_INLINE static PackedMask less_or_equal(const Values& a, const Values& b) {
    PackedMask r;
    HALYARD_EACH_PIECE r.piece[i] = a.piece[i] <= b.piece[i];
    return r;
  }
  /// True if all entries are set.
  HALYARD_INLINE bool all() const {
    bool set = true;
    HALYARD_EACH_PIECE set &= lane_math::all(piece[i]);
    return set;
  }
  /// The entries of a where the mask is set, elsewhere those of b.
  HALYARD_INLINE Values choose(Values a, const Values& b) const {
    HALYARD_EACH_PIECE a.piece[i] = piece[i] ? a.piece[i] : b.piece[i];
    return a;
  }
};

#undef HALYARD_EACH_PIECE

}  // namespace halyard

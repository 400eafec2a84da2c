#pragma once
/// A step in time that an integrator can follow: from 0 to 1 within a width around an instant:
///
///   s(t) = u² (3 - 2u),  u = (t - t_0) / w + 1/2  within [0, 1]
///
///   t_0   instant at which the step is 1/2      s
///   w     width; kStepWidth if it is sharp       s
///
/// Its rate is continuous. The step is exactly 0 before and exactly 1 after.

#include "transmission/scalar.h"

namespace halyard {

inline constexpr double kStepWidth = 0.01;  ///< s

template <class T>
struct SmoothStep {
  T value, rate;  ///< -, 1/s
};

template <class T>
HALYARD_INLINE SmoothStep<T> smooth_step(double time, const T& at, const T& width = T(kStepWidth)) {
  const T after = T(time) - at;
  // Half a width beyond the edges, where rounding cannot move u into (0, 1).
  if (holds(after <= -width)) return {0.0, 0.0};
  if (holds(after >= width)) return {1.0, 0.0};
  const T u = max(T(0.0), min(T(1.0), T(after / width + T(0.5))));
  return {u * u * (T(3.0) - T(2.0) * u), T(6.0) / width * u * (T(1.0) - u)};
}

}  // namespace halyard

#pragma once
/// A wave by its two amplitudes: cosine cos(phase) + sine sin(phase). phase: rad.

#include "transmission/scalar.h"

namespace halyard {

template <class T>
HALYARD_INLINE T harmonic(const T& cosine, const T& sine, const T& phase) {
  T sin_phase, cos_phase;
  sin_cos(phase, sin_phase, cos_phase);
  return cosine * cos_phase + sine * sin_phase;
}

}  // namespace halyard

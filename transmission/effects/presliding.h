#pragma once
/// Friction that is elastic before it slides. The share ρ of the Coulomb friction follows Dahl's equation instead of
/// the speed:
///
///   F' = F + ρ (1 + g) F_c (z / z_y - tanh(v / v_s)),   ż = v - |v| z / z_y
///
///   z     elastic deflection of the contacts         rad | m
///   z_y   deflection at which they slide: |z| < z_y  rad | m
///   F_c   Coulomb level                              N m | N
///   ρ     share of it                                -
///   g     relative change of the friction in time, of the effect `friction_drift`    -
///
/// After a reversal the friction turns round over a deflection of some z_y, however slow the motion. It is passive
/// while ρ is at most one.
/// Source: Dahl, "A solid friction model", Aerospace Corporation TOR-0158 (1968), with the exponent 1; LuGre's equation
/// without its damping (Canudas de Wit et al., IEEE Trans. Automatic Control 40 (1995)).

#include "transmission/friction.h"

namespace halyard::effects {

/// F' - F of a drive or joint that moves at v. p: ρ and z_y, the effect's parameters; drift: g.
template <class T>
HALYARD_INLINE T presliding_force(const T* p, const T& coulomb, const T& smoothing, const T& v, const T& z,
                                  const T& drift) {
  return p[0] * max(T(0.0), T(T(1.0) + drift)) * coulomb * (z / p[1] - smooth_sign(v, smoothing));
}

template <class T>
HALYARD_INLINE T presliding_rate(const T* p, const T& v, const T& z) {
  return v - abs(v) * z / p[1];
}

}  // namespace halyard::effects

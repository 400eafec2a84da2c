#pragma once
/// Regularised friction: tanh(v / v_s) replaces sign(v).
///
///   F = F_c tanh(v / v_s) + F_v v,  opposing the motion v           (paper, Eqs. 4 and 5)
///
///   F_c, F_v   Coulomb level, viscous coefficient    N m | N,  N m s/rad | N s/m
///   v_s        speed at which Coulomb friction reaches 76 % of F_c; near standstill the slope of Coulomb friction,
///              F_c / v_s, is the stiffest term in the arm's equations            rad/s | m/s

#include "transmission/scalar.h"

namespace halyard {

/// sign(v), regularised.
template <class T>
HALYARD_INLINE T smooth_sign(const T& v, const T& v_s) {
  return tanh(T(v / v_s));
}

template <class T>
HALYARD_INLINE T friction(const T& coulomb, const T& viscous, const T& v_s, const T& v) {
  return coulomb * smooth_sign(v, v_s) + viscous * v;
}

}  // namespace halyard

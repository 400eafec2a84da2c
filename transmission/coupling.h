#pragma once
/// Routing past inboard pulleys lets one joint move several cables: the path of the cables is
/// s = R q, R = diag(r_l) C, and the joint forces return by virtual work: Γ = Rᵀ g.
///
///   s, g   length that each cable gives up to the joints, its force    [n_cable]   m, N
///   q, Γ   joint coordinate, force                                      [n_joint]   rad, N m | m, N
///   C      coupling matrix: C_ij is what joint j adds to cable i's path, C_ii = 1
///   r_l    link pulley radius                                           m | 1
///
/// The paper gives the stretch (Eq. 8) but not the reaction Γ_j on the inboard joints; without it
/// the arm makes energy from nothing.

#include "transmission/arm_parameters.h"

namespace halyard {

/// s = R q. q, s: [n]; works for rates as well.
template <class T>
HALYARD_INLINE void cable_path(const ArmParameters<T>& arm, const T* q, T* s) {
  for (int i = 0; i < arm.n; ++i) {
    T sum = 0.0;
    for (int j = 0; j < arm.n; ++j) sum += arm.joint[i].coupling[j] * q[j];
    s[i] = arm.joint[i].pulley_radius * sum;
  }
}

/// Γ = Rᵀ g. g, force: [n].
template <class T>
HALYARD_INLINE void joint_reaction(const ArmParameters<T>& arm, const T* g, T* force) {
  for (int j = 0; j < arm.n; ++j) {
    T sum = 0.0;
    for (int i = 0; i < arm.n; ++i) sum += arm.joint[i].pulley_radius * arm.joint[i].coupling[j] * g[i];
    force[j] = sum;
  }
}

}  // namespace halyard

#pragma once
/// Accelerations of the rigid chain with the rotors of rigid drives, and their slopes:
///
///   (M + M_rotors) a + h(q, q') = F      ∂a = (M + M_rotors)⁻¹ (∂F - ∂(M a + h) at constant a)
///
/// M_rotors is constant. Dual numbers differentiate the inverse dynamics in q and q'; they do not pass through M.

#include "model/rigid_chain.h"
#include "transmission/coupling.h"

namespace halyard {

/// M + M_rotors as ldl_factor() leaves it; replaces the forces F [n] by the accelerations.
template <int known>
HALYARD_INLINE void factor_and_accelerate(const ArmParameters<double>& arm, const double* q, const double* v,
                                          double* force, double M[][kMaxJoints]) {
  const int n = joint_count<known>(arm);
  const ChainPose<double> pose = chain_pose<known>(arm, q);
  mass_matrix<known>(arm, pose, M);
  add_rotor_mass<known>(arm, M);
  ldl_factor<double, kMaxJoints>(n, M);
  double zero[kMaxJoints], h[kMaxJoints];
  for (int k = 0; k < n; ++k) zero[k] = 0;
  inverse_dynamics<known>(arm, pose, v, zero, h);
  for (int k = 0; k < n; ++k) force[k] -= h[k];
  ldl_solve<double, kMaxJoints>(n, M, force);
}

/// Subtracts from the slopes in q and q', the first 2 n columns, those of M a + h.
template <int known>
HALYARD_INLINE void subtract_force_slopes(const ArmParameters<double>& arm, const double* q, const double* v,
                                          const double* a, double* slopes, int stride) {
  const int n = joint_count<known>(arm);
  for (int first = 0; first < 2 * n; first += kDualWidth) {
    const int count = 2 * n - first < kDualWidth ? 2 * n - first : kDualWidth;
    Dual y[2 * kMaxJoints], held[kMaxJoints], force[kMaxJoints];
    for (int k = 0; k < n; ++k) y[k] = q[k], y[n + k] = v[k], held[k] = a[k];
    for (int i = 0; i < count; ++i) y[first + i].d.set(i, 1);
    inverse_dynamics<known>(arm, chain_pose<known>(arm, y), y + n, held, force);
    for (int i = 0; i < count; ++i)
      for (int k = 0; k < n; ++k) slopes[k + (first + i) * stride] -= force[k].d[i];
  }
}

template <int known>
HALYARD_INLINE void accelerate_with_slopes_of(const ArmParameters<double>& arm, const double* q, const double* v,
                                              double* force, double* slopes, int stride, int columns) {
  double M[kMaxJoints][kMaxJoints];
  factor_and_accelerate<known>(arm, q, v, force, M);
  subtract_force_slopes<known>(arm, q, v, force, slopes, stride);
  for (int c = 0; c < columns; ++c) ldl_solve<double, kMaxJoints>(joint_count<known>(arm), M, slopes + c * stride);
}

}  // namespace halyard

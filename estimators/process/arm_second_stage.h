#pragma once
/// The second stage x_2 of a step from x, for a plain transmission under the paper's cable law. With the linearisation A at
/// x, which is not repeated at x_2,
///
///   f(x_2)     = f(x) + A (x_2 - x) + D
///   f(x_2 + d) = f(x_2) + A d + N(d),   N(d) = N' d + higher terms,   so that ∂f/∂x at x_2 is A + N'
///
/// Frictions depend on one speed each and cables on one stretch, so that N is the drives' answer to few forces:
///
///   motors   J N = -(e + r u)        e   friction over its tangent at x        [2 n]: motors, then joints
///   joints   M N = -e + Rᵀ u         u   cable force over its tangent at x     [n]
///
/// Of the chain, M and the slopes of M a + h are those of x. D has the chain's forces at x_2, so that M of x multiplies
/// only the rest, which is small:
///
///   M D = F(x_2) - (M(q_2) a + h(q_2, q_2')),   a: accelerations of f(x) + A (x_2 - x)

#include "estimators/process/arm_curvature.h"

namespace halyard {

/// D [moving rows, from l.positions on], and of `end`, the point at x_2, what friction, cables and M are. start, x_dot, A:
/// of linearise() at x.
template <int known>
HALYARD_INLINE void second_stage(const LinearisedArm& model, const LinearisedPoint& start, const double* x,
                                 const double* x_dot, const double* A, const double* x_2, LinearisedPoint& end,
                                 double* D) {
  const PlainTransmission& t = *model.plain;
  const ArmParameters<double>& arm = model.arm;
  const StateLayout& l = model.layout;
  const int n = joint_count<known>(arm), first = l.positions;
  set_frictions(t, n, x_2, end.friction);
  set_cable_forces<known>(t, arm, model.transmission.arm(), l, x_2, end.cable);
  double d[kMaxStates], q[kMaxJoints], v[kMaxJoints], a[kMaxJoints], rest[kMaxJoints], chain[kMaxJoints];
  for (int i = 0; i < l.size; ++i) d[i] = x_2[i] - x[i];
  for (int i = 0; i < n * n; ++i) end.mobility[i] = start.mobility[i];
  for (int k = 0; k < n; ++k) {
    q[k] = x_2[l.position[k]], v[k] = x_2[l.rate[k]], a[k] = x_dot[l.rate[k]];
    rest[k] = start.force[k] - (end.friction.value[n + k] - start.friction.value[n + k]);
  }
  for (int c = 0; c < l.effect_states; ++c)
    for (int k = 0; k < n; ++k) a[k] += A[l.rate[k] + c * l.size] * d[c];
  for (int k = 0; k < n; ++k) {
    const double pull = end.cable.value[k] - start.cable.value[k],
                 over = end.friction.value[k] - start.friction.value[k] - start.friction.slope[k] * d[*l.motor_rate[k]];
    double stretch = t.travel[k] * d[*l.motor_angle[k]], stretch_rate = t.travel[k] * d[*l.motor_rate[k]];
    for (int i = 0; i < n; ++i) {
      rest[i] += t.path[k][i] * pull;
      stretch -= t.path[k][i] * d[l.position[i]];
      stretch_rate -= t.path[k][i] * d[l.rate[i]];
    }
    const double tangent = start.cable.stiff[k] * stretch + start.cable.damped[k] * stretch_rate;
    D[*l.motor_rate[k] - first] = -t.per_rotor_inertia[k] * (over + t.travel[k] * (pull - tangent));
  }
  inverse_dynamics<known>(arm, chain_pose<known>(arm, q), v, a, chain);
  for (int k = 0; k < n; ++k) rest[k] -= chain[k];
  mobility_times(start, n, rest, a);
  for (int k = 0; k < n; ++k) D[l.rate[k] - first] = a[k];
}

/// rates [moving rows] = factor N of eight deviations d at a time: rows of [size], in `blocks` lanes each. friction(i, ∂v): e
/// of friction i; cable(k, ∂x): u of cable k.
template <int known, class Friction, class Cable>
HALYARD_INLINE void set_excess(const LinearisedArm& model, const LinearisedPoint& start, double factor, int blocks,
                               const Lanes* d, Lanes* rates, const Friction& friction, const Cable& cable) {
  const PlainTransmission& t = *model.plain;
  const StateLayout& l = model.layout;
  const int n = joint_count<known>(model.arm), first = l.positions;
  double mobility[kMaxJoints * kMaxJoints], per_inertia[kMaxJoints];
  for (int i = 0; i < n * n; ++i) mobility[i] = factor * start.mobility[i];
  for (int k = 0; k < n; ++k) per_inertia[k] = -factor * t.per_rotor_inertia[k];
  for (int b = 0; b < blocks; ++b, ++d, ++rates) {
    Lanes force[kMaxJoints], pull[kMaxJoints];
    for (int k = 0; k < n; ++k) {
      const int rate = *l.motor_rate[k];
      pull[k] = cable(k, stretch_of(t, l, n, k, d, blocks));
      force[k] = -friction(n + k, d[l.rate[k] * blocks]);
      rates[(rate - first) * blocks] = per_inertia[k] * (friction(k, d[rate * blocks]) + t.travel[k] * pull[k]);
    }
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < n; ++i) force[i] += t.path[k][i] * pull[k];
    for (int k = 0; k < n; ++k) {
      Lanes sum = mobility[k] * force[0];
      for (int i = 1; i < n; ++i) sum += mobility[k + i * n] * force[i];
      rates[(l.rate[k] - first) * blocks] = sum;
    }
  }
}

/// factor N(d), where d need not be narrow for friction; the cables are taken as quadratic.
template <int known>
HALYARD_INLINE void set_far_excess(const LinearisedArm& model, const LinearisedPoint& start, const LinearisedPoint& end,
                                   const double* x_2, double factor, int blocks, const Lanes* d, Lanes* rates) {
  const PlainTransmission& t = *model.plain;
  const auto of_friction = [&](int i, const Lanes& change) __attribute__((always_inline)) {
    const Lanes sign = smooth_sign(x_2[t.speed[i]] + change, Lanes(t.smoothing[i]));
    return t.coulomb[i] * (sign - end.friction.sign[i]) + (t.viscous[i] - start.friction.slope[i]) * change;
  };
  const auto of_cable = [&](int k, const Lanes& stretch) __attribute__((always_inline)) {
    return (end.cable.stiff[k] - start.cable.stiff[k] + (0.5 * end.cable.curvature[k]) * stretch) * stretch;
  };
  set_excess<known>(model, start, factor, blocks, d, rates, of_friction, of_cable);
}

/// factor N' d.
template <int known>
HALYARD_INLINE void set_near_excess(const LinearisedArm& model, const LinearisedPoint& start,
                                    const LinearisedPoint& end, double factor, int blocks, const Lanes* d,
                                    Lanes* rates) {
  const auto of_friction = [&](int i, const Lanes& change) __attribute__((always_inline)) {
    return (end.friction.slope[i] - start.friction.slope[i]) * change;
  };
  const auto of_cable = [&](int k, const Lanes& stretch) __attribute__((always_inline)) {
    return (end.cable.stiff[k] - start.cable.stiff[k]) * stretch;
  };
  set_excess<known>(model, start, factor, blocks, d, rates, of_friction, of_cable);
}

}  // namespace halyard

#pragma once
/// The second stage x_2 of a step from x, for a plain transmission under the paper's cable law. With the linearisation
/// A at x, which is not repeated at x_2,
///
///   f(x_2)     = f(x) + A (x_2 - x) + D
///   f(x_2 + d) = f(x_2) + A d + N(d),   N(d) = N' d + higher terms,   so that ∂f/∂x at x_2 is A + N'
///
/// The chain is taken as linear. Frictions depend on one speed each and cables on one stretch, so that D and N are the
/// drives' answer to few forces:
///
///   motors   J D = -(e + r u)        e   friction over its tangent at x        [2 n]: motors, then joints
///   joints   M D = -e + Rᵀ u         u   cable force over its tangent at x     [n]
///
/// The excess rate is the largest change of a damping rate f' / J or of a cable's rate √(s r² / J); J: inertia of the
/// motor, or 1 / (M⁻¹)_kk. Where it is small beside 1/h, N' is not needed, and a later step can keep A.

#include "estimators/process/arm_curvature.h"

namespace halyard {

/// Their answer in the moving rows, from l.positions on, `blocks` numbers apart. e: [2 n], u: [n].
template <class T>
HALYARD_INLINE void answer_of_drives(const LinearisedArm& model, const ChainPoint& chain, int n, const T* e, const T* u,
                                     int blocks, T* rates) {
  const PlainTransmission& t = *model.plain;
  const StateLayout& l = model.layout;
  T force[kMaxJoints];
  for (int k = 0; k < n; ++k) {
    force[k] = -e[n + k];
    rates[(*l.motor_rate[k] - l.positions) * blocks] = -t.per_rotor_inertia[k] * (e[k] + t.travel[k] * u[k]);
  }
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) force[i] += t.path[k][i] * u[k];
  for (int k = 0; k < n; ++k) {
    T sum = chain.mobility[k] * force[0];
    for (int i = 1; i < n; ++i) sum += chain.mobility[k + i * n] * force[i];
    rates[(l.rate[k] - l.positions) * blocks] = sum;
  }
}

/// Of friction and cables, against the slopes of A.
HALYARD_INLINE double excess_rate(const PlainTransmission& t, int n, const LinearisedPoint& of_A,
                                  const Frictions& friction, const CableForces& cable) {
  double most = 0;
  for (int k = 0; k < n; ++k) {
    const double rates[3] = {t.per_rotor_inertia[k] * abs(friction.slope[k] - of_A.friction.slope[k]),
                             of_A.chain.mobility[k * (n + 1)] * abs(friction.slope[n + k] - of_A.friction.slope[n + k]),
                             abs(t.travel[k] * __builtin_sqrt(t.per_rotor_inertia[k]) *
                                 (__builtin_sqrt(cable.stiff[k]) - __builtin_sqrt(of_A.cable.stiff[k])))};
    for (const double rate : rates) most = max(most, rate);
  }
  return most;
}

/// D [moving rows], and of `end`, the point at x_2, what friction and cables are. start: of linearise() at x.
template <int known>
HALYARD_INLINE void second_stage(const LinearisedArm& model, const LinearisedPoint& start, const double* x,
                                 const double* x_2, LinearisedPoint& end, double* D) {
  const PlainTransmission& t = *model.plain;
  const StateLayout& l = model.layout;
  const int n = joint_count<known>(model.arm);
  set_frictions(t, n, x_2, end.friction);
  set_cable_forces<known>(t, model.arm, model.transmission.arm(), l, x_2, end.cable);
  double d[kMaxStates], e[2 * kMaxJoints], u[kMaxJoints];
  for (int i = 0; i < l.size; ++i) d[i] = x_2[i] - x[i];
  for (int i = 0; i < 2 * n; ++i)
    e[i] = end.friction.value[i] - start.friction.value[i] - start.friction.slope[i] * d[t.speed[i]];
  for (int k = 0; k < n; ++k) {
    double stretch_rate = t.travel[k] * d[*l.motor_rate[k]];
    for (int i = 0; i < n; ++i) stretch_rate -= t.path[k][i] * d[l.rate[i]];
    u[k] = end.cable.value[k] - start.cable.value[k] - start.cable.stiff[k] * stretch_of(t, l, n, k, d, 1) -
           start.cable.damped[k] * stretch_rate;
  }
  answer_of_drives(model, start.chain, n, e, u, 1, D);
  end.excess_rate = excess_rate(t, n, start, end.friction, end.cable);
}

/// f at x, not far from where A and `point` were found: A, M and all slopes stay, and what else friction and cables are
/// becomes that of x, with the excess rate.
template <int known>
HALYARD_INLINE void set_rates_beside(const LinearisedArm& model, const HeldInputs& in, const double* x, double* x_dot,
                                     LinearisedPoint& point) {
  const PlainTransmission& t = *model.plain;
  const StateLayout& l = model.layout;
  const int n = joint_count<known>(model.arm);
  Frictions friction;
  CableForces cable;
  double force[kMaxJoints];
  set_plain_forces<known>(t, model.arm, model.transmission.arm(), l, in.command, in.external, x, friction, cable, x_dot,
                          force);
  set_accelerations<known>(model.arm, l, pose_at<known>(model.arm, l, x), x, force, point.chain, x_dot);
  point.excess_rate = excess_rate(t, n, point, friction, cable);
  for (int i = 0; i < 2 * n; ++i) {
    point.friction.sign[i] = friction.sign[i];
    point.friction.value[i] = friction.value[i];
    point.friction.curvature[i] = friction.curvature[i];
  }
  for (int k = 0; k < n; ++k) {
    point.cable.value[k] = cable.value[k];
    point.cable.curvature[k] = cable.curvature[k];
  }
}

/// rates [moving rows] = factor N of eight deviations d at a time: rows of [size], in `blocks` lanes each. friction(i,
/// ∂v): e of friction i; cable(k, ∂x): u of cable k.
template <int known, class Friction, class Cable>
HALYARD_INLINE void set_excess(const LinearisedArm& model, const LinearisedPoint& start, double factor, int blocks,
                               const Lanes* d, Lanes* rates, const Friction& friction, const Cable& cable) {
  const PlainTransmission& t = *model.plain;
  const int n = joint_count<known>(model.arm);
  for (int b = 0; b < blocks; ++b, ++d, ++rates) {
    Lanes e[2 * kMaxJoints], u[kMaxJoints];
    for (int i = 0; i < 2 * n; ++i) e[i] = factor * friction(i, d[t.speed[i] * blocks]);
    for (int k = 0; k < n; ++k) u[k] = factor * cable(k, stretch_of(t, model.layout, n, k, d, blocks));
    answer_of_drives(model, start.chain, n, e, u, blocks, rates);
  }
}

/// Friction is constant within 1e-8 beyond this many times its smoothing speed.
inline constexpr double kSaturated = 10;

/// factor N(d), where d need not be narrow for friction; the cables are taken as quadratic.
template <int known>
HALYARD_INLINE void set_far_excess(const LinearisedArm& model, const LinearisedPoint& start, const LinearisedPoint& end,
                                   const double* x_2, double factor, int blocks, const Lanes* d, Lanes* rates) {
  const PlainTransmission& t = *model.plain;
  const auto of_friction = [&](int i, const Lanes& change) __attribute__((always_inline)) {
    const double v = x_2[t.speed[i]], away = v < 0 ? -v : v;
    const Lanes tangent = (t.viscous[i] - start.friction.slope[i]) * change;
    if (holds(abs(change) < away - kSaturated * t.smoothing[i])) return tangent;
    const Lanes sign = tanh((v + change) * t.per_smoothing[i]);
    return t.coulomb[i] * (sign - end.friction.sign[i]) + tangent;
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

#pragma once
/// The second stage x_2 of a step from x, for a plain transmission without kinks near x. With a linearisation A at x,
/// or at a state shortly before, which is not repeated at x_2,
///
///   f(x_2)     = f(x) + A (x_2 - x) + D
///   f(x_2 + d) = f(x_2) + A d + N(d),   N(d) = N' d + higher terms,   so that ∂f/∂x at x_2 is A + N'
///
/// The chain is taken as linear. Frictions depend on one speed each and cables on one stretch, so that D and N are the
/// drives' answer to few forces:
///
///   motors   J D = -(e + r u)        e   friction over the tangent with A's slope       [2 n]: motors, then joints
///   joints   M D = -e + Rᵀ u         u   cable force over the tangent with A's slopes   [n]
///
/// The excess rate is the largest change, since A, of a damping rate f' / J or r² d / J, or of the rate √(s r² / J) of
/// a cable or of √((s r² + p) / J) under an effect's force; J: inertia of the motor, or 1 / (M⁻¹)_kk, whose r is R_kk.
/// Where it is small beside 1/h, N' is not needed, and a later step can keep A.

#include "estimators/process/plain/arm_curvature.h"

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

/// Change of the rate of a drive with this stiffness when an effect adds one of either sign.
HALYARD_INLINE double change_of_rate(double stiffness, double added, double per_inertia) {
  const double size = abs(added);
  if (size == 0) return 0;
  return __builtin_sqrt(per_inertia) * size / (__builtin_sqrt(abs(stiffness) + size) + __builtin_sqrt(abs(stiffness)));
}

/// Of friction and cables, against the slopes of A.
HALYARD_INLINE double excess_rate(const PlainTransmission& t, int n, const LinearisedPoint& of_A,
                                  const Frictions& friction, const CableForces& cable) {
  const DriveSlopes& old = of_A.of_A;
  double most = 0;
  for (int k = 0; k < n; ++k) {
    const double per_inertia[2] = {t.per_rotor_inertia[k], of_A.chain.mobility[k * (n + 1)]};
    const double radius[2] = {t.travel[k], t.path[k][k]};
    for (int side = 0; side < 2; ++side) {
      const int i = k + side * n;
      most = max(most, per_inertia[side] * abs(friction.slope[i] - old.in_rate[i]));
      if (t.forces.empty()) continue;
      most = max(most, change_of_rate(radius[side] * radius[side] * old.stiff[k],
                                      friction.in_position[i] - old.in_position[i], per_inertia[side]));
    }
    if (!t.of_cable[k].empty())
      most = max(most, t.travel[k] * t.travel[k] * t.per_rotor_inertia[k] * abs(cable.damped[k] - old.damped[k]));
    most = max(most, t.rate_per_root[k] * abs(__builtin_sqrt(abs(cable.stiff[k])) - old.root_of_stiff[k]));
  }
  return most;
}

/// D [moving rows], and of `end`, the point at x_2 and at `time`, what friction and cables are. start: at x.
template <int known>
HALYARD_INLINE void second_stage(const LinearisedArm& model, double time, const LinearisedPoint& start, const double* x,
                                 const double* x_2, LinearisedPoint& end, double* D) {
  const PlainTransmission& t = *model.plain;
  const StateLayout& l = model.layout;
  const int n = joint_count<known>(model.arm);
  set_frictions<known>(t, model.transmission, time, x_2, end.friction);
  set_cable_forces<known>(t, model.transmission, model.arm, l, time, x_2, end.cable);
  const DriveSlopes& A = start.of_A;
  double d[kMaxStates], e[2 * kMaxJoints], u[kMaxJoints];
  for (int i = 0; i < l.size; ++i) d[i] = x_2[i] - x[i];
  for (int i = 0; i < 2 * n; ++i) e[i] = end.friction.value[i] - start.friction.value[i] - A.in_rate[i] * d[t.speed[i]];
  if (!t.forces.empty())
    for (int i = 0; i < 2 * n; ++i) e[i] -= A.in_position[i] * d[t.position[i]];
  for (int k = 0; k < n; ++k)
    u[k] = end.cable.value[k] - start.cable.value[k] - A.stiff[k] * stretch_of(t, l, n, k, d, 1) -
           A.damped[k] * stretch_rate_of(t, l, n, k, d, 1);
  answer_of_drives(model, start.chain, n, e, u, 1, D);
  end.excess_rate = excess_rate(t, n, start, end.friction, end.cable);
}

/// f at x, not far from where A and `point` were found: A, M and the slopes of A stay, and what else friction and
/// cables are becomes that of x, with the excess rate.
template <int known>
HALYARD_INLINE void set_rates_beside(const LinearisedArm& model, double time, const HeldInputs& in, const double* x,
                                     double* x_dot, LinearisedPoint& point) {
  const int n = joint_count<known>(model.arm);
  set_plain_forces<known>(model, time, in, x, point.friction, point.cable, x_dot, point.force);
  set_accelerations<known>(model.arm, model.layout, pose_at<known>(model.arm, model.layout, x), x, point.force,
                           point.chain, x_dot);
  point.excess_rate = excess_rate(*model.plain, n, point, point.friction, point.cable);
}

/// The force of cable k against that which the slopes of A give, of the deviation d.
HALYARD_INLINE Lanes near_cable(const LinearisedArm& model, const DriveSlopes& A, const CableForces& at, int n, int k,
                                const Lanes* d, int blocks) {
  const PlainTransmission& t = *model.plain;
  Lanes force = (at.stiff[k] - A.stiff[k]) * stretch_of(t, model.layout, n, k, d, blocks);
  if (at.damped[k] != A.damped[k])
    force += (at.damped[k] - A.damped[k]) * stretch_rate_of(t, model.layout, n, k, d, blocks);
  return force;
}

/// Friction is constant within 1e-8 beyond this many times its smoothing speed.
inline constexpr double kSaturated = 10;

/// e [2 n] = factor N of friction, where d need not be narrow in speed: what it is more at x + d than at x, less A d.
/// x, friction: at `time`. d: rows, `blocks` lanes each.
template <int known>
HALYARD_INLINE void set_far_friction(const LinearisedArm& model, double time, const DriveSlopes& A, const double* x,
                                     const Frictions& friction, double factor, int blocks, const Lanes* d, Lanes* e) {
  const PlainTransmission& t = *model.plain;
  const int drives = 2 * joint_count<known>(model.arm);
  for (int i = 0; i < drives; ++i) {
    const Lanes change = d[t.speed[i] * blocks];
    const double v = x[t.speed[i]], away = v < 0 ? -v : v;
    e[i] = (factor * (t.viscous[i] - A.in_rate[i])) * change;
    if (!holds(abs(change) < away - kSaturated * t.smoothing[i]))
      e[i] += (factor * t.coulomb[i]) * (tanh((v + change) * t.per_smoothing[i]) - friction.sign[i]);
  }
  if (t.forces.empty()) return;
  for (int i = 0; i < drives; ++i)
    e[i] += (factor * (friction.in_position[i] - A.in_position[i])) * d[t.position[i] * blocks] -
            factor * friction.of_rate[i];
  for (const ForceTerm& term : t.forces) {
    if (!term.of_rate) continue;
    e[term.drive] += factor * force_of(model.lanes, term, time, Lanes(d[term.state * blocks] + x[term.state]));
  }
}

/// rates [moving rows] = factor N(d) of eight deviations d at a time: rows of [size], in `blocks` lanes each. d need
/// not be narrow for friction; the cables are taken as quadratic. end: at x_2 and `time`.
template <int known>
HALYARD_INLINE void set_far_excess(const LinearisedArm& model, double time, const LinearisedPoint& start,
                                   const LinearisedPoint& end, const double* x_2, double factor, int blocks,
                                   const Lanes* d, Lanes* rates) {
  const int n = joint_count<known>(model.arm);
  for (int b = 0; b < blocks; ++b, ++d, ++rates) {
    Lanes e[2 * kMaxJoints], u[kMaxJoints];
    set_far_friction<known>(model, time, start.of_A, x_2, end.friction, factor, blocks, d, e);
    for (int k = 0; k < n; ++k) {
      const Lanes stretch = stretch_of(*model.plain, model.layout, n, k, d, blocks);
      u[k] = factor * (near_cable(model, start.of_A, end.cable, n, k, d, blocks) +
                       (0.5 * end.cable.curvature[k]) * stretch * stretch);
    }
    answer_of_drives(model, start.chain, n, e, u, blocks, rates);
  }
}

/// rates = factor N' d, with the slopes of `at` less those of A.
template <int known>
HALYARD_INLINE void set_near_excess(const LinearisedArm& model, const LinearisedPoint& start, const LinearisedPoint& at,
                                    double factor, int blocks, const Lanes* d, Lanes* rates) {
  const PlainTransmission& t = *model.plain;
  const DriveSlopes& A = start.of_A;
  const int n = joint_count<known>(model.arm);
  for (int b = 0; b < blocks; ++b, ++d, ++rates) {
    Lanes e[2 * kMaxJoints], u[kMaxJoints];
    for (int i = 0; i < 2 * n; ++i) e[i] = (factor * (at.friction.slope[i] - A.in_rate[i])) * d[t.speed[i] * blocks];
    if (!t.forces.empty())
      for (int i = 0; i < 2 * n; ++i)
        e[i] += (factor * (at.friction.in_position[i] - A.in_position[i])) * d[t.position[i] * blocks];
    for (int k = 0; k < n; ++k) u[k] = factor * near_cable(model, A, at.cable, n, k, d, blocks);
    answer_of_drives(model, start.chain, n, e, u, blocks, rates);
  }
}

}  // namespace halyard

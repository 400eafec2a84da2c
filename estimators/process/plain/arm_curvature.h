#pragma once
/// Mean of N_i = f(x + d_i) - f(x) - A d_i over narrow deviations d_i, for a plain transmission without kinks near x.
/// Frictions, cables and effects have a curvature in one direction each, so that the variance of this speed, position
/// or stretch says all: its mean force is that of two deviations with the same variance. Of the chain, the inverse
/// dynamics D(q, q', a) = M(q) a + h(q, q') is evaluated at each deviation, eight at a time:
///
///   M n_i = ½ F''(d_i, d_i) - (D(q + δq, q' + δq', a + δa) - D - D' (δq, δq') - M δa)        n: the joints' part of N
///
///   d    gamma times a column of the root S                 δq, δq'   its parts of the joints
///   δa   what A makes of d                                  D'        slopes at constant a (ChainPoint)

#include "estimators/matrix/product_tiles.h"
#include "estimators/process/arm_linearisation.h"

namespace halyard {

/// Sums over the deviations.
struct CurvatureSums {
  Lanes speed[2 * kMaxJoints];  ///< squares of the root's rows: of motors, then joints
  Lanes stretch[kMaxJoints];    ///< squares of what they make of the stretches
};

/// Adds the squares of eight deviations: lanes of each row of the root.
HALYARD_INLINE void add_squares(const PlainTransmission& t, const StateLayout& l, int n, const Lanes* root, int blocks,
                                CurvatureSums& sums) {
  for (int k = 0; k < n; ++k) {
    const Lanes stretch = stretch_of(t, l, n, k, root, blocks);
    sums.stretch[k] += stretch * stretch;
    const Lanes motor = root[*l.motor_rate[k] * blocks], joint = root[l.rate[k] * blocks];
    sums.speed[k] += motor * motor;
    sums.speed[n + k] += joint * joint;
  }
}

/// Adds what D of eight deviations is more than its linear part to the sums [n]. D: at x.
template <int known>
HALYARD_INLINE void add_chain(const ArmParameters<double>& arm, const StateLayout& l, const ChainPoint& point,
                              const double* D, const double* x, const double* x_dot, const double* A, double gamma,
                              const Lanes* root, int blocks, Lanes* sums) {
  const int n = joint_count<known>(arm);
  Lanes q[kMaxJoints], v[kMaxJoints], a[kMaxJoints], dq[kMaxJoints], dv[kMaxJoints], da[kMaxJoints], force[kMaxJoints];
  for (int k = 0; k < n; ++k) {
    const int position = l.position[k], rate = l.rate[k];
    q[k] = gamma * root[position * blocks] + x[position], dq[k] = q[k] - x[position];
    v[k] = gamma * root[rate * blocks] + x[rate], dv[k] = v[k] - x[rate];
    da[k] = Lanes(0.0);
  }
  for (int c = 0; c < l.size; ++c) {
    const Lanes d = root[c * blocks];
    for (int k = 0; k < n; ++k) da[k] += A[l.rate[k] + c * l.size] * d;
  }
  for (int k = 0; k < n; ++k) a[k] = gamma * da[k] + x_dot[l.rate[k]], da[k] = a[k] - x_dot[l.rate[k]];
  chain_force<known>(arm, chain_pose<known>(arm, q), v, a, force);
  for (int k = 0; k < n; ++k) {
    Lanes rest = force[k] - D[k];
    for (int i = 0; i < n; ++i)
      rest -= point.slope[k][i] * dq[i] + point.slope[k][n + i] * dv[i] + point.mass[k][i] * da[i];
    sums[k] += rest;
  }
}

/// D = M a + h at x, with a of x_dot.
template <int known>
HALYARD_INLINE void set_chain_force(const ArmParameters<double>& arm, const StateLayout& l, const double* x,
                                    const double* x_dot, double* D) {
  double q[kMaxJoints], v[kMaxJoints], a[kMaxJoints];
  for (int k = 0, n = joint_count<known>(arm); k < n; ++k)
    q[k] = x[l.position[k]], v[k] = x[l.rate[k]], a[k] = x_dot[l.rate[k]];
  chain_force<known>(arm, chain_pose<known>(arm, q), v, a, D);
}

/// The chain's part of the mean of N over `count` deviations, into the point at x. root: rows of S [size x count], in
/// `blocks` lanes each, with zeros beyond `count`. x_dot, A and point: at x.
template <int known>
HALYARD_INLINE void chain_curvature(const LinearisedArm& model, LinearisedPoint& point, const double* x,
                                    const double* x_dot, const double* A, double gamma, int count, int blocks,
                                    const Lanes* root) {
  const int n = joint_count<known>(model.arm);
  double D[kMaxJoints];
  Lanes sums[kMaxJoints];
  set_chain_force<known>(model.arm, model.layout, x, x_dot, D);
  for (int k = 0; k < n; ++k) sums[k] = Lanes(0.0);
  for (int b = 0; b < blocks; ++b)
    add_chain<known>(model.arm, model.layout, point.chain, D, x, x_dot, A, gamma, root + b, blocks, sums);
  for (int k = 0; k < n; ++k) point.chain.curvature[k] = tiles::sum_of(sums[k]) / count;
}

/// In the first lanes `at`, and the two values that lie so far beside it.
HALYARD_INLINE Lanes pair_about(double at, double deviation) {
  Lanes points(at);
  points.set(1, at + deviation);
  points.set(2, at - deviation);
  return points;
}
/// Mean of a force at these two, less that between them.
HALYARD_INLINE double mean_of_pair(const Lanes& force) { return 0.5 * (force[1] + force[2]) - force[0]; }

/// Adds the means of the forces of effects over `count` deviations: to force [2 n] against friction's direction, to
/// pull [n] of the cables. root: rows, `blocks` lanes each.
template <int known>
HALYARD_INLINE void add_mean_forces(const LinearisedArm& model, double time, const double* x, double gamma, int count,
                                    int blocks, const Lanes* root, double* force, double* pull) {
  const PlainTransmission& t = *model.plain;
  const StateLayout& l = model.layout;
  const int n = joint_count<known>(model.arm);
  for (const ForceTerm& term : t.forces) {
    Lanes squares(0.0);
    for (int b = 0; b < blocks; ++b) squares += root[term.state * blocks + b] * root[term.state * blocks + b];
    const double deviation = gamma * __builtin_sqrt(tiles::sum_of(squares) / count);
    force[term.drive] += mean_of_pair(force_of(model.lanes, term, time, pair_about(x[term.state], deviation)));
  }
  for (int k = 0; k < n; ++k) {
    if (t.of_cable[k].empty()) continue;
    Lanes squares(0.0);
    for (int b = 0; b < blocks; ++b) {
      const Lanes stretch = stretch_of(t, l, n, k, root + b, blocks);
      squares += stretch * stretch;
    }
    const double deviation = gamma * __builtin_sqrt(tiles::sum_of(squares) / count);
    const Lanes stretch = pair_about(stretch_of(t, l, n, k, x, 1), deviation);
    pull[k] += mean_of_pair(
        cable_force_of(model.lanes, t.of_cable[k], k, time, stretch, Lanes(stretch_rate_of(t, l, n, k, x, 1))));
  }
}

/// mean [size] of N over such deviations, of a plain transmission. chain: of a state shortly before, with its
/// curvature. point: at x and `time`.
template <int known>
HALYARD_INLINE void mean_curvature(const LinearisedArm& model, double time, const double* x, const ChainPoint& chain,
                                   const LinearisedPoint& point, double gamma, int count, int blocks, const Lanes* root,
                                   double* mean) {
  const PlainTransmission& t = *model.plain;
  const StateLayout& l = model.layout;
  const int n = joint_count<known>(model.arm);
  CurvatureSums sums;
  for (int k = 0; k < n; ++k) sums.speed[k] = sums.speed[n + k] = sums.stretch[k] = Lanes(0.0);
  for (int b = 0; b < blocks; ++b) add_squares(t, l, n, root + b, blocks, sums);
  const double half = 0.5 * gamma * gamma / count;
  double held[2 * kMaxJoints], force[kMaxJoints], pull[kMaxJoints], accelerations[kMaxJoints];
  for (int i = 0; i < 2 * n; ++i) held[i] = half * point.friction.curvature[i] * tiles::sum_of(sums.speed[i]);
  for (int k = 0; k < n; ++k) pull[k] = half * point.cable.curvature[k] * tiles::sum_of(sums.stretch[k]);
  add_mean_forces<known>(model, time, x, gamma, count, blocks, root, held, pull);
  for (int k = 0; k < n; ++k) force[k] = -held[n + k] - chain.curvature[k];
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) force[i] += t.path[k][i] * pull[k];
  mobility_times(chain, n, force, accelerations);
  for (int i = 0; i < l.size; ++i) mean[i] = 0;
  for (int k = 0; k < n; ++k) {
    mean[*l.motor_rate[k]] = -t.per_rotor_inertia[k] * (held[k] + t.travel[k] * pull[k]);
    mean[l.rate[k]] = accelerations[k];
  }
}

}  // namespace halyard

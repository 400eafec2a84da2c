#pragma once
/// The arm's answer to impulses that reach beyond the smoothing speed of friction, for a plain transmission without
/// kinks near x: sub-steps of the deviations d alone, where those of process_model.h move whole states.
///
///   d' = A d + N(s, d),   d(0) = G          Γ = (G + 4 d(h/2) + d(h)) / 6, as in noise.h
///
///   A      ∂f/∂x at x, the start of the step, or at a state shortly before
///   N      the drives' answer to the excess of friction over what A says (arm_second_stage.h), about states that go
///          straight from x to x_2 at the end; cables and chain are taken as linear
///   h, s   length of the step, time in it                          s
///
/// The sub-steps are those of the classical Runge-Kutta method.

#include "estimators/process/plain/arm_second_stage.h"

namespace halyard {

/// d' of eight deviations at the part s of the step. d, rates: positions and their rates.
template <int known>
HALYARD_INLINE void deviation_rates(const LinearisedArm& model, const ImpulseStep& step, double s, const Lanes* d,
                                    Lanes* rates) {
  const PlainTransmission& t = *model.plain;
  const StateLayout& l = model.layout;
  const int n = joint_count<known>(model.arm), first = 2 * n, end = 4 * n;
  double at[kMaxStates];
  for (int i = 0; i < end; ++i) at[i] = step.x[i] + s * (step.x_2[i] - step.x[i]);
  const double time = step.time_s + s * step.dt_s;
  Frictions friction;
  set_frictions<known>(t, model.transmission, time, at, friction);
  Lanes e[2 * kMaxJoints], u[kMaxJoints];
  set_far_friction<known>(model, time, step.start.of_A, at, friction, 1, 1, d, e);
  for (int k = 0; k < n; ++k) u[k] = Lanes(0.0);
  answer_of_drives(model, step.start.chain, n, e, u, 1, rates + first);
  for (int i = 0; i < first; ++i) {
    rates[i] = d[first + i];
    for (int c = 0; c < end; ++c) rates[first + i] += step.A[first + i + c * l.size] * d[c];
  }
}

/// Γ of impulses G: rows of [size] in `blocks` lanes each, of which those of constant states are left as they are.
template <int known>
HALYARD_INLINE void impulse_response(const LinearisedArm& model, const ImpulseStep& step, int blocks, const Lanes* G,
                                     Lanes* Gamma) {
  const int size = 4 * joint_count<known>(model.arm);
  const double h = step.dt_s / step.substeps;
  for (int b = 0; b < blocks; ++b, ++G, ++Gamma) {
    Lanes d[kMaxStates], rates[kMaxStates], sum[kMaxStates], at[kMaxStates];
    for (int i = 0; i < size; ++i) d[i] = G[i * blocks], Gamma[i * blocks] = (1.0 / 6) * d[i];
    for (int j = 0; j < step.substeps; ++j) {
      for (int i = 0; i < size; ++i) at[i] = d[i], sum[i] = Lanes(0.0);
      for (int stage = 0; stage < 4; ++stage) {  // a loop, so that there is one copy of the rates
        const double into = stage == 0 ? 0 : stage < 3 ? 0.5 : 1, next = stage < 2 ? 0.5 * h : h;
        deviation_rates<known>(model, step, (j + into) / step.substeps, at, rates);
        const double weight = stage == 0 || stage == 3 ? h / 6 : h / 3;
        for (int i = 0; i < size; ++i) {
          sum[i] += weight * rates[i];
          at[i] = d[i] + next * rates[i];
        }
      }
      for (int i = 0; i < size; ++i) d[i] += sum[i];
      const double share = 2 * (j + 1) == step.substeps ? 4.0 / 6 : j + 1 == step.substeps ? 1.0 / 6 : 0;
      for (int i = 0; i < size; ++i) Gamma[i * blocks] += share * d[i];
    }
  }
}

}  // namespace halyard

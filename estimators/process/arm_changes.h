#pragma once
/// What x' changes by when the state changes by d, for any transmission:
///
///   f(t, x + d) - f(t_0, x)      J δq_m'' = δ(τ - (r_m / N) g),   M δa = δF - C (δq, δq')
///
///   t_0     time at which x' is known at x     s
///   M, C    masses of the chain, and slopes of M a + h at constant a, as they are at x or shortly before: the chain is
///           taken as linear
///
/// The transmission, with all effects, is evaluated at x + d, for eight deviations at a time.

#include "estimators/process/arm_linearisation.h"

namespace halyard {

/// x' and F at a state x.
struct KnownRates {
  const double *x, *x_dot, *force;
};

/// Rows of the rates of motors and joints and of the internal states, from l.positions on. d, changes: in `blocks`
/// lanes a row. first_force: F at the first deviation; null: not wanted.
template <int known>
HALYARD_INLINE void set_changes(const Transmission<Lanes>& transmission, const StateLayout& l, double time,
                                const CommandHistory* history, const Lanes* command, const Lanes* external,
                                const ChainPoint& chain, const KnownRates& at, int blocks, const Lanes* d,
                                Lanes* changes, double* first_force) {
  const ArmParameters<Lanes>& arm = transmission.arm();
  const int n = joint_count<known>(arm);
  for (int b = 0; b < blocks; ++b, ++d, ++changes) {
    Lanes x[kMaxStates], force[kMaxJoints], motor_acceleration[kMaxJoints], z_dot[kMaxStates];
    for (int i = 0; i < l.size; ++i) x[i] = d[i * blocks] + at.x[i];
    set_forces<known>(transmission, l, time, history, command, external, x, force, motor_acceleration, z_dot);
    if (b == 0 && first_force)
      for (int k = 0; k < n; ++k) first_force[k] = force[k][0];
    for (int k = 0; k < n; ++k) {
      force[k] -= at.force[k];
      for (int i = 0; i < n; ++i)
        force[k] -= chain.slope[k][i] * d[l.position[i] * blocks] + chain.slope[k][n + i] * d[l.rate[i] * blocks];
    }
    const auto put = [&](int row, const Lanes& rate) __attribute__((always_inline)) {
      changes[(row - l.positions) * blocks] = rate;
    };
    for (int k = 0; k < n; ++k) {
      Lanes acceleration = chain.mobility[k] * force[0];
      for (int i = 1; i < n; ++i) acceleration += chain.mobility[k + i * n] * force[i];
      put(l.rate[k], acceleration);
      if (arm.joint[k].drive == Drive::cable) put(*l.motor_rate[k], motor_acceleration[k] - at.x_dot[*l.motor_rate[k]]);
    }
    for (int i = l.effect_states; i < l.size; ++i) put(i, z_dot[i - l.effect_states] - at.x_dot[i]);
  }
}

}  // namespace halyard

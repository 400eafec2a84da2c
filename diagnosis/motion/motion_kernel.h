#pragma once
/// The arm driven by a measured motor motion. The joints follow through the cables, and the result includes the
/// motor torque that the motion requires. Errors of the model do not accumulate, because the motors' motion is given.
///
///   given q_m(t), q_m'(t), q_m''(t):
///   M(q) q'' + h(q, q') = F(q_m, q_m', q, q')           integrated: predicted joint position
///   ε = τ(command) - (r_m / N) g - J q_m''               torque residual at the motor shaft
///
/// A rigidly driven joint has its motion prescribed; its transmission force λ follows from
/// R q'' = (r_m / N) q_m'' and replaces g. A joint without a motor has its own motion prescribed, with q'' given: an
/// unknown force λ holds or drives it.

#include <utility>

#include "diagnosis/motion/chebyshev.h"
#include "estimators/process/arm_dynamics.h"

namespace halyard {

/// Motor motion and known torques at one instant, [n]; for a joint without a motor, the joint's own motion.
struct DrivenInput {
  double motor_angle[kMaxJoints], motor_rate[kMaxJoints], motor_acceleration[kMaxJoints];
  double torque[kMaxJoints], external[kMaxJoints];
};

/// State of the driven arm: [q, q'] of each joint, then the internal states of the effects.
template <class T>
struct DrivenState {
  T q[kMaxJoints], v[kMaxJoints], z[kMaxStates];
};

/// Sets the position and rate of joints with prescribed motion.
template <int known = 0, class T>
HALYARD_INLINE void prescribe(const ArmParameters<T>& arm, const DrivenInput& u, DrivenState<T>& x) {
  for (int k = 0, n = joint_count<known>(arm); k < n; ++k) {
    const JointParameters<T>& j = arm.joint[k];
    if (j.drive == Drive::none) {
      x.q[k] = T(u.motor_angle[k]) - j.joint_encoder_offset;
      x.v[k] = u.motor_rate[k];
    }
    if (j.drive != Drive::rigid) continue;
    x.q[k] = rigid_joint(arm, k, T(u.motor_angle[k] - j.motor_encoder_offset), x.q);
    x.v[k] = rigid_joint(arm, k, T(u.motor_rate[k]), x.v);
  }
}

/// The rigid chain changes little within this time, s: it is computed once, for the middle.
inline constexpr double kChainHeld = 0.008;

/// So many samples share a chain.
inline std::size_t samples_of_chain(double dt) {
  return std::max(std::size_t{1}, static_cast<std::size_t>(kChainHeld / dt + 0.5));
}

/// The rigid chain over a few samples.
template <class T>
struct HeldChain {
  T M[kMaxJoints][kMaxJoints];  ///< factored mass matrix, with the rotors of rigid drives
  T bias[kMaxJoints];           ///< velocity and gravity forces
  int n_prescribed = 0;
  int prescribed[kMaxJoints];          ///< joints with a rigid drive or none
  T row[kMaxJoints][kMaxJoints];       ///< R: a row of the path matrix, or of the unit matrix where there is no drive
  T response[kMaxJoints][kMaxJoints];  ///< M⁻¹ R_rᵀ of each
  T A[kMaxJoints][kMaxJoints];         ///< factored R M⁻¹ Rᵀ
};

template <int known = 0, class T>
HALYARD_INLINE void chain_at(const ArmParameters<T>& arm, const T* q, const T* v, HeldChain<T>& chain) {
  const int n = joint_count<known>(arm);
  T zero[kMaxJoints];
  for (int k = 0; k < n; ++k) zero[k] = T(0.0);
  const ChainPose<T> pose = chain_pose<known>(arm, q);
  inverse_dynamics<known>(arm, pose, v, zero, chain.bias);
  mass_matrix<known>(arm, pose, chain.M);
  add_rotor_mass<known>(arm, chain.M);
  ldl_factor<T, kMaxJoints>(n, chain.M);
  chain.n_prescribed = 0;
  for (int k = 0; k < n; ++k)
    if (arm.joint[k].drive != Drive::cable) chain.prescribed[chain.n_prescribed++] = k;
  for (int r = 0; r < chain.n_prescribed; ++r) {
    const int k = chain.prescribed[r];
    const JointParameters<T>& j = arm.joint[k];
    for (int i = 0; i < n; ++i) {
      chain.row[r][i] = j.drive == Drive::rigid ? path_per_joint(j, i) : T(i == k ? 1.0 : 0.0);
      chain.response[r][i] = chain.row[r][i];
    }
    ldl_solve<T, kMaxJoints>(n, chain.M, chain.response[r]);
  }
  for (int r = 0; r < chain.n_prescribed; ++r)
    for (int c = 0; c < chain.n_prescribed; ++c) {
      T sum = 0.0;
      for (int i = 0; i < n; ++i) sum += chain.row[c][i] * chain.response[r][i];
      chain.A[c][r] = sum;
    }
  ldl_factor<T, kMaxJoints>(chain.n_prescribed, chain.A);
}

/// The chain for the middle of the next `held` s. before: the rates as long ago; the joints go on accelerating as since
/// then.
template <int known = 0, class T>
HALYARD_INLINE void chain_ahead(const ArmParameters<T>& arm, const T* q, const T* v, const T* before, double held,
                                HeldChain<T>& chain) {
  T middle[kMaxJoints], rate[kMaxJoints];
  for (int k = 0, n = joint_count<known>(arm); k < n; ++k) {
    rate[k] = v[k] + T(0.5) * (v[k] - before[k]);
    middle[k] = q[k] + T(0.25 * held) * (v[k] + rate[k]);
  }
  chain_at<known>(arm, middle, rate, chain);
}

/// Accelerations of the joints as the motors' motion gives them, without stretch: for sensors that lag.
template <int known = 0, class T>
HALYARD_INLINE void set_accelerations(const ArmParameters<T>& arm, const DrivenInput& u, JointSignals<T>* s) {
  T a[kMaxJoints];
  for (int k = 0, n = joint_count<known>(arm); k < n; ++k) {
    const T own = u.motor_acceleration[k];
    s[k].joint_acceleration = a[k] = arm.joint[k].drive == Drive::none ? own : rigid_joint(arm, k, own, a);
  }
}

/// Rates of x; torque_residual [n] and joint_reading [n] if not null. Without a chain there are no accelerations; only
/// arms with cables at all joints allow this.
template <class T, int known = 0>
HALYARD_INLINE void driven_derivative(const Transmission<T>& transmission, const HeldChain<T>* chain, double time,
                                      const CommandHistory* history, const DrivenInput& u, const DrivenState<T>& x,
                                      DrivenState<T>& rate, T* torque_residual, T* joint_reading) {
  const ArmParameters<T>& arm = transmission.arm();
  const int n = joint_count<known>(arm);
  ArmSignals<T> signals(n);
  JointSignals<T>* s = signals.joint();
  for (int k = 0; k < n; ++k) {
    s[k].command = u.torque[k];
    s[k].motor_angle = u.motor_angle[k];
    s[k].motor_rate = u.motor_rate[k];
    s[k].joint_position = x.q[k];
    s[k].joint_rate = x.v[k];
    s[k].external_force = u.external[k];
  }
  if (joint_reading) set_accelerations<known>(arm, u, s);
  // The angle from the encoder's reading: errors are small, so one correction is enough.
  transmission.template sensor_errors<known>(time, x.z, s);
  for (int k = 0; k < n; ++k) {
    s[k].motor_angle -= s[k].motor_error;
    if (joint_reading) joint_reading[k] = x.q[k] + s[k].joint_error;
  }
  transmission.template evaluate<known>(time, history, x.z, s, rate.z,
                                        torque_residual ? MotorTorques::wanted : MotorTorques::unwanted);

  T a[kMaxJoints];
  for (int k = 0; k < n; ++k) a[k] = chain ? T(s[k].joint_force - chain->bias[k]) : T(0.0);
  if (chain) ldl_solve<T, kMaxJoints>(n, chain->M, a);

  // Prescribed motion: λ from (R M⁻¹ Rᵀ) λ = b'' - R a with b'' = (r_m/N) q_m'' or q'', then a += M⁻¹ Rᵀ λ.
  if (chain && chain->n_prescribed > 0) {
    T lambda[kMaxJoints];
    for (int r = 0; r < chain->n_prescribed; ++r) {
      const int k = chain->prescribed[r];
      const bool rigid = arm.joint[k].drive == Drive::rigid;
      lambda[r] = (rigid ? arm.joint[k].motor_travel() : T(1.0)) * u.motor_acceleration[k];
      for (int i = 0; i < n; ++i) lambda[r] -= chain->row[r][i] * a[i];
    }
    ldl_solve<T, kMaxJoints>(chain->n_prescribed, chain->A, lambda);
    for (int r = 0; r < chain->n_prescribed; ++r) {
      const int k = chain->prescribed[r];
      for (int i = 0; i < n; ++i) a[i] += chain->response[r][i] * lambda[r];
      const JointParameters<T>& j = arm.joint[k];  // M carries its rotor, which is no part of the transmission's force
      if (j.drive == Drive::rigid)
        s[k].cable_force_motor = lambda[r] - j.rotor_inertia * u.motor_acceleration[k] / j.motor_travel();
    }
  }

  for (int k = 0; k < n; ++k) {
    rate.q[k] = x.v[k];
    rate.v[k] = a[k];
    if (!torque_residual) continue;
    const JointParameters<T>& j = arm.joint[k];
    torque_residual[k] =
        rotor_torque(j, s[k].motor_torque, s[k].cable_force_motor) - j.rotor_inertia * u.motor_acceleration[k];
  }
}

template <class T>
HALYARD_INLINE void axpy(int n, int m, double h, const DrivenState<T>& x, const DrivenState<T>& rate,
                         DrivenState<T>& y) {
  for (int k = 0; k < n; ++k) {
    y.q[k] = x.q[k] + T(h) * rate.q[k];
    y.v[k] = x.v[k] + T(h) * rate.v[k];
  }
  for (int k = 0; k < m; ++k) y.z[k] = x.z[k] + T(h) * rate.z[k];
}

/// The cubic between values a and b with slopes a_dot and b_dot, at the share u of their distance h.
HALYARD_INLINE double hermite(double a, double a_dot, double b, double b_dot, double h, double u) {
  const double rise = b - a;
  return a + u * (rise + (1 - u) * ((1 - u) * (h * a_dot - rise) - u * (h * b_dot - rise)));
}

/// The input between two samples h apart, at the share u of their distance; the torque is held.
HALYARD_INLINE void interpolate(int n, const DrivenInput& a, const DrivenInput& b, double h, double u,
                                DrivenInput& at) {
  for (int k = 0; k < n; ++k) {
    at.motor_angle[k] = hermite(a.motor_angle[k], a.motor_rate[k], b.motor_angle[k], b.motor_rate[k], h, u);
    at.motor_rate[k] =
        hermite(a.motor_rate[k], a.motor_acceleration[k], b.motor_rate[k], b.motor_acceleration[k], h, u);
    at.motor_acceleration[k] = a.motor_acceleration[k] + u * (b.motor_acceleration[k] - a.motor_acceleration[k]);
    at.torque[k] = a.torque[k];
    at.external[k] = a.external[k] + u * (b.external[k] - a.external[k]);
  }
}

/// The input h after the last sample.
HALYARD_INLINE DrivenInput moved_on(int n, DrivenInput last, double h) {
  for (int k = 0; k < n; ++k) {
    last.motor_angle[k] += h * (last.motor_rate[k] + 0.5 * h * last.motor_acceleration[k]);
    last.motor_rate[k] += h * last.motor_acceleration[k];
  }
  return last;
}

/// The recursion of an inner stage: before, the stage before the last, becomes the new stage.
template <class T>
struct StageRecursion {
  T stay, mu, nu, mu_h, gamma_h;

  HALYARD_INLINE StageRecursion(const RungeKuttaChebyshev& c, int j, double h)
      : stay(1 - c.mu[j] - c.nu[j]), mu(c.mu[j]), nu(c.nu[j]), mu_h(c.mu_h[j] * h), gamma_h(c.gamma_h[j] * h) {}
  HALYARD_INLINE void advance(int n, const T* start, const T* last, const T* rate, const T* first_rate,
                              T* before) const {
    for (int k = 0; k < n; ++k)
      before[k] = stay * start[k] + mu * last[k] + nu * before[k] + mu_h * rate[k] + gamma_h * first_rate[k];
  }
};

template <class T>
HALYARD_INLINE void copy_state(int n, int m, const DrivenState<T>& from, DrivenState<T>& to) {
  for (int k = 0; k < n; ++k) to.q[k] = from.q[k], to.v[k] = from.v[k];
  for (int k = 0; k < m; ++k) to.z[k] = from.z[k];
}

/// One step of x from time over h; input(t, at) sets the DrivenInput at time t. row, if not null: torque residual [n]
/// and joint reading [n] at the start of the step.
template <int known = 0, class T, class Input>
HALYARD_INLINE void driven_step(const Transmission<T>& transmission, const HeldChain<T>& chain, double time, double h,
                                const RungeKuttaChebyshev& c, const CommandHistory* history, const Input& input,
                                DrivenState<T>& x, T* row) {
  const int n = joint_count<known>(transmission.arm()), m = transmission.n_states();
  DrivenInput at;
  DrivenState<T> f0, f, stage[2];
  input(time, at);
  driven_derivative<T, known>(transmission, &chain, time, history, at, x, f0, row, row ? row + n : nullptr);
  copy_state(n, m, x, stage[0]);
  axpy(n, m, c.mu_h[1] * h, x, f0, stage[1]);
  DrivenState<T>*before = &stage[0], *last = &stage[1];
  for (int j = 2; j <= c.stages; ++j) {
    const double then = time + c.node[j - 1] * h;
    input(then, at);
    // Past commands affect the torque residual only, which inner stages do not compute.
    driven_derivative<T, known>(transmission, &chain, then, nullptr, at, *last, f, nullptr, nullptr);
    const StageRecursion<T> recursion(c, j, h);
    recursion.advance(n, x.q, last->q, f.q, f0.q, before->q);
    recursion.advance(n, x.v, last->v, f.v, f0.v, before->v);
    recursion.advance(m, x.z, last->z, f.z, f0.z, before->z);
    std::swap(before, last);
  }
  copy_state(n, m, *last, x);
}

/// Integrates a whole record. Sample i writes the torque residual to out[i * 2n + k] and the predicted joint reading to
/// out[i * 2n + n + k]. x is the initial state and becomes the final one. states [size][2n + effects' states], if not
/// null, receives x at every sample. known: see joint_count().
template <int known = 0, class T>
HALYARD_INLINE void drive_record(const Transmission<T>& transmission, const DrivenInput* samples, std::size_t size,
                                 double start, double dt, const RungeKuttaChebyshev& scheme,
                                 const CommandHistory* history, DrivenState<T>& x, T* out, T* states) {
  const ArmParameters<T>& arm = transmission.arm();
  const int n = joint_count<known>(arm), m = transmission.n_states();
  const std::size_t held = samples_of_chain(dt);
  HeldChain<T> chain;
  T before[kMaxJoints];
  DrivenInput beyond;
  for (std::size_t i = 0; i < size; ++i) {
    const double time = start + dt * static_cast<double>(i);
    const DrivenInput& a = samples[i];
    const DrivenInput& b = i + 1 < size ? samples[i + 1] : beyond = moved_on(n, a, dt);
    prescribe<known>(arm, a, x);
    if (states) {
      T* row = states + i * (2 * n + m);
      for (int k = 0; k < n; ++k) row[k] = x.q[k], row[n + k] = x.v[k];
      for (int k = 0; k < m; ++k) row[2 * n + k] = x.z[k];
    }
    const auto input = [&](double t, DrivenInput& at) { interpolate(n, a, b, dt, (t - time) / dt, at); };
    if (i % held == 0) {
      chain_ahead<known>(arm, x.q, x.v, i == 0 ? x.v : before, dt * static_cast<double>(held), chain);
      for (int k = 0; k < n; ++k) before[k] = x.v[k];
    }
    const double h = dt / scheme.steps;
    for (int s = 0; s < scheme.steps; ++s)
      driven_step<known>(transmission, chain, time + s * h, h, scheme, history, input, x,
                         s == 0 ? out + i * 2 * n : nullptr);
  }
}

/// Computes the output of drive_record from its `states`: for hypotheses that differ only in parameters on which the
/// motion does not depend.
template <int known, class T>
HALYARD_INLINE void replay_record(const Transmission<T>& transmission, const DrivenInput* samples, std::size_t size,
                                  double start, double dt, const CommandHistory* history, const T* states, T* out) {
  const ArmParameters<T>& arm = transmission.arm();
  const int n = joint_count<known>(arm), m = transmission.n_states();
  bool prescribed = false;
  for (int k = 0; k < n; ++k) prescribed = prescribed || arm.joint[k].drive != Drive::cable;
  const std::size_t held = samples_of_chain(dt);
  HeldChain<T> chain;
  for (std::size_t i = 0; i < size; ++i) {
    const T* from = states + i * (2 * n + m);
    DrivenState<T> x, rate;
    for (int k = 0; k < n; ++k) x.q[k] = from[k], x.v[k] = from[n + k];
    for (int k = 0; k < m; ++k) x.z[k] = from[2 * n + k];
    if (prescribed && i % held == 0) {
      const T* before = i == 0 ? from : from - held * (2 * n + m);
      chain_ahead<known>(arm, x.q, x.v, before + n, dt * static_cast<double>(held), chain);
    }
    T* row = out + i * 2 * n;
    driven_derivative<T, known>(transmission, prescribed ? &chain : nullptr, start + dt * static_cast<double>(i),
                                history, samples[i], x, rate, row, row + n);
  }
}

}  // namespace halyard

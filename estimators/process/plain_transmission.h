#pragma once
/// A transmission that is linear but for the cables' forces and the friction: cables drive all joints, and no effect
/// acts between the commands and the joints but unknown constants of a filter, which add a multiple of their state to a
/// cable's stretch or to a joint's force. Then few derivatives say everything:
///
///   x_k  = r_k q_m,k - Σ_j R_kj q_j + b_k           x_k' = r_k q_m,k' - Σ_j R_kj q_j'
///   ∂g_k = s_k ∂x_k + d_k ∂x_k' + ½ c_k ∂x_k²       ∂(friction) = f' ∂v + ½ f'' ∂v²
///
///   q_m, q   motor angle, joint position                    [n]       rad, rad | m
///   r, R     cable travel per motor angle, path per joint   [n], [n x n]
///   b        unknown constant times its factor              [n]       m
///   g        force of the cable                             [n]       N
///   s, d, c  its slopes, and its curvature, which is exact for the paper's law only     N/m, N s/m, N/m²
///   v        speed of a motor or joint                      [2 n]: motors, then joints

#include <optional>

#include "estimators/process/arm_dynamics.h"

namespace halyard {

/// An effect that adds `factor` times its single state, which is constant, to a signal of its joint.
class ConstantTerm {
 public:
  virtual ~ConstantTerm() = default;
  /// stretch or joint.
  virtual EffectStage added_at() const = 0;
  virtual double factor() const = 0;
};

struct PlainTransmission {
  static constexpr int kSpeeds = 2 * kLaneWidth;  ///< room for those of motors and joints

  struct Constant {
    int state = -1;  ///< -1: none
    double factor = 0;
  };
  double travel[kMaxJoints], per_rotor_inertia[kMaxJoints], path[kMaxJoints][kMaxJoints];
  Constant stretch[kMaxJoints], force[kMaxJoints];
  alignas(Lanes) double coulomb[kSpeeds], viscous[kSpeeds], smoothing[kSpeeds], per_smoothing[kSpeeds];
  int speed[kSpeeds];  ///< index in the state
};

/// Empty if the transmission is not plain.
std::optional<PlainTransmission> plain_transmission(const Transmission<double>& transmission,
                                                    const StateLayout& layout);

/// Friction of motors and joints at the state x.
struct Frictions {
  alignas(Lanes) double sign[PlainTransmission::kSpeeds], value[PlainTransmission::kSpeeds],
      slope[PlainTransmission::kSpeeds], curvature[PlainTransmission::kSpeeds];
};

HALYARD_INLINE Lanes* lanes_of(double* a) { return reinterpret_cast<Lanes*>(a); }
HALYARD_INLINE const Lanes* lanes_of(const double* a) { return reinterpret_cast<const Lanes*>(a); }

/// n: number of joints.
HALYARD_INLINE void set_frictions(const PlainTransmission& t, int n, const double* x, Frictions& f) {
  alignas(Lanes) double speed[PlainTransmission::kSpeeds];
  const int blocks = (2 * n + kLaneWidth - 1) / kLaneWidth;
  for (int i = 0; i < blocks * kLaneWidth; ++i) speed[i] = x[t.speed[i]];
  for (int b = 0; b < blocks; ++b) {
    const Lanes v = lanes_of(speed)[b], per_v_s = lanes_of(t.per_smoothing)[b], F_c = lanes_of(t.coulomb)[b],
                F_v = lanes_of(t.viscous)[b];
    const Lanes sign = tanh(v * per_v_s), steep = F_c * per_v_s * (Lanes(1.0) - sign * sign);
    lanes_of(f.sign)[b] = sign;
    lanes_of(f.value)[b] = F_c * sign + F_v * v;
    lanes_of(f.slope)[b] = steep + F_v;
    lanes_of(f.curvature)[b] = Lanes(-2.0) * sign * steep * per_v_s;
  }
}

/// Forces of the cables, their slopes and curvature. `dual`: the parameters of `arm`.
struct CableForces {
  alignas(Lanes) double value[kLaneWidth], stiff[kLaneWidth], damped[kLaneWidth], curvature[kLaneWidth];
};

template <int known>
HALYARD_INLINE void set_cable_forces(const PlainTransmission& t, const ArmParameters<double>& arm,
                                     const ArmParameters<Dual>& dual, const StateLayout& l, const double* x,
                                     CableForces& g) {
  const int n = joint_count<known>(arm);
  Lanes stretch(0.0);
  for (int k = 0; k < n; ++k) {
    double at = t.travel[k] * x[*l.motor_angle[k]], rate = t.travel[k] * x[*l.motor_rate[k]];
    for (int i = 0; i < n; ++i) {
      at -= t.path[k][i] * x[l.position[i]];
      rate -= t.path[k][i] * x[l.rate[i]];
    }
    if (t.stretch[k].state >= 0) at += t.stretch[k].factor * x[t.stretch[k].state];
    stretch.set(k, at);
    g.damped[k] = rate;
  }
  const Lanes sine = sinh(stretch);
  for (int k = 0; k < n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    if (j.law == CableLaw::paper) {
      const double s = sine[k], rate = g.damped[k];
      g.value[k] = 2 * (j.stiffness * s + j.damping * rate);
      g.stiff[k] = 2 * j.stiffness * __builtin_sqrt(1 + s * s);
      g.damped[k] = 2 * j.damping;
      g.curvature[k] = 2 * j.stiffness * s;
    } else {
      const Dual force = cable_force(dual.joint[k], Dual::seed(stretch[k], 0), Dual::seed(g.damped[k], 1));
      g.value[k] = force.a, g.stiff[k] = force.d[0], g.damped[k] = force.d[1], g.curvature[k] = 0;
    }
  }
}

}  // namespace halyard

#pragma once
/// A transmission whose derivatives are few: cables drive all joints, and between the commands and the joints there are
/// only effects of one signal (transmission/effects/one_signal.h), and unknown constants of a filter, which add a
/// multiple of their state to a cable's stretch or to a joint's force.
///
///   x_k  = r_k q_m,k - Σ_j R_kj q_j + b_k           x_k' = r_k q_m,k' - Σ_j R_kj q_j'
///   ∂g_k = s_k ∂x_k + d_k ∂x_k' + ½ c_k ∂x_k²       ∂(friction) = f' ∂v + ½ f'' ∂v² + p ∂(position)
///
///   q_m, q   motor angle, joint position                    [n]       rad, rad | m
///   r, R     cable travel per motor angle, path per joint   [n], [n x n]
///   b        unknown constant times its factor              [n]       m
///   g        force of the cable                             [n]       N
///   s, d, c  its slopes, and its curvature, which is exact for the paper's law only     N/m, N s/m, N/m²
///   v        speed of a motor or joint                      [2 n]: motors, then joints
///   p        slope of an effect's force in the position of motor or joint               [2 n]
///
/// "Friction" includes the forces of effects at motor and joint, "cable" the effects at its stretch and force.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "estimators/process/arm_dynamics.h"
#include "estimators/process/plain/effect_terms.h"

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
  double travel[kMaxJoints], per_rotor_inertia[kMaxJoints];
  double rate_per_root[kMaxJoints];  ///< r / √J: of the motor on its cable, per √s
  double path[kMaxJoints][kMaxJoints];
  Constant stretch[kMaxJoints], force[kMaxJoints];
  alignas(Lanes) double coulomb[kSpeeds], viscous[kSpeeds], smoothing[kSpeeds], per_smoothing[kSpeeds];
  int speed[kSpeeds], position[kSpeeds];  ///< indices in the state
  std::vector<ForceTerm> forces;
  std::vector<EffectTerm> of_cable[kMaxJoints];  ///< at its stretch and force
  bool has_kinks[kMaxJoints] = {};               ///< one of these has

  bool has_effects() const;
};

/// Empty if the transmission is not plain.
std::optional<PlainTransmission> plain_transmission(const Transmission<double>& transmission,
                                                    const StateLayout& layout);

/// What a deviation makes of the stretch of cable k. d: its rows, or lanes of them, `blocks` apart.
template <class T>
HALYARD_INLINE T stretch_of(const PlainTransmission& t, const StateLayout& l, int n, int k, const T* d, int blocks) {
  T stretch = t.travel[k] * d[*l.motor_angle[k] * blocks];
  for (int i = 0; i < n; ++i) stretch -= t.path[k][i] * d[l.position[i] * blocks];
  if (t.stretch[k].state >= 0) stretch += t.stretch[k].factor * d[t.stretch[k].state * blocks];
  return stretch;
}

/// The same of its rate.
template <class T>
HALYARD_INLINE T stretch_rate_of(const PlainTransmission& t, const StateLayout& l, int n, int k, const T* d,
                                 int blocks) {
  T rate = t.travel[k] * d[*l.motor_rate[k] * blocks];
  for (int i = 0; i < n; ++i) rate -= t.path[k][i] * d[l.rate[i] * blocks];
  return rate;
}

/// Friction of motors and joints at the state x.
struct Frictions {
  alignas(Lanes) double value[PlainTransmission::kSpeeds];
  double slope[PlainTransmission::kSpeeds], in_position[PlainTransmission::kSpeeds];
  double of_rate[PlainTransmission::kSpeeds];                                      ///< the part of effects in speed
  double sign[PlainTransmission::kSpeeds], curvature[PlainTransmission::kSpeeds];  ///< without effects
};

HALYARD_INLINE Lanes* lanes_of(double* a) { return reinterpret_cast<Lanes*>(a); }
HALYARD_INLINE const Lanes* lanes_of(const double* a) { return reinterpret_cast<const Lanes*>(a); }

/// Without the forces of effects. n: number of joints, known where this is inlined.
HALYARD_INLINE void set_own_frictions(const PlainTransmission& t, int n, const double* x, Frictions& f) {
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
    lanes_of(f.in_position)[b] = lanes_of(f.of_rate)[b] = Lanes(0.0);
  }
}

/// dual: the transmission that is plain.
template <int known>
HALYARD_INLINE void set_frictions(const PlainTransmission& t, const Transmission<Dual>& dual, double time,
                                  const double* x, Frictions& f) {
  set_own_frictions(t, joint_count<known>(dual.arm()), x, f);
  for (const ForceTerm& term : t.forces) {
    const Dual force = force_of(dual, term, time, Dual::seed(x[term.state], 0));
    f.value[term.drive] += force.a;
    if (term.of_rate) f.of_rate[term.drive] += force.a;
    (term.of_rate ? f.slope : f.in_position)[term.drive] += force.d[0];
  }
}

/// Forces of the cables, their slopes and curvature.
struct CableForces {
  alignas(Lanes) double value[kLaneWidth], stiff[kLaneWidth], damped[kLaneWidth], curvature[kLaneWidth];
};

/// The curvature is that under the paper's law, without effects; else 0.
template <int known>
HALYARD_INLINE void set_cable_forces(const PlainTransmission& t, const Transmission<Dual>& dual,
                                     const ArmParameters<double>& arm, const StateLayout& l, double time,
                                     const double* x, CableForces& g) {
  const int n = joint_count<known>(arm);
  Lanes stretch(0.0);
  double rate[kMaxJoints];
  for (int k = 0; k < n; ++k) {
    stretch.set(k, stretch_of(t, l, n, k, x, 1));
    rate[k] = stretch_rate_of(t, l, n, k, x, 1);
  }
  const Lanes sine = sinh(stretch);
  for (int k = 0; k < n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    if (j.law == CableLaw::paper && t.of_cable[k].empty()) {
      const double y = sine[k];
      g.value[k] = 2 * (j.stiffness * y + j.damping * rate[k]);
      g.stiff[k] = 2 * j.stiffness * __builtin_sqrt(1 + y * y);
      g.damped[k] = 2 * j.damping;
      g.curvature[k] = 2 * j.stiffness * y;
    } else {
      const Dual force =
          cable_force_of(dual, t.of_cable[k], k, time, Dual::seed(stretch[k], 0), Dual::seed(rate[k], 1));
      g.value[k] = force.a, g.stiff[k] = force.d[0], g.damped[k] = force.d[1], g.curvature[k] = 0;
    }
  }
}

/// True if an effect of a cable has a kink between the states x and x_2, or within so many standard deviations beside
/// them: the force there is not on its tangent at x. S: root of the covariance of x.
bool has_kink_near(const PlainTransmission& plain, const Transmission<double>& transmission, const StateLayout& layout,
                   double time, const double* x, const CableForces& at_x, const double* x_2, double deviations,
                   const Eigen::Ref<const Eigen::MatrixXd>& S);

}  // namespace halyard

#include "transmission/effects/built_in.h"
#include "transmission/effects/one_signal.h"
#include "transmission/friction.h"

/// Friction that changes in time, as in a drive that warms up. The Coulomb level and viscous coefficient of the motor
/// are multiplied by 1 + g, those of the joint by 1 + σ g; so is friction that is elastic before it slides
/// (presliding.h). The drift is
///
///   g = max(-1, α + ρ (1 - exp(-λ t)) / λ),   t >= 0
///
///   ρ   `rate`: relative change per second at the start; in all it changes by ρ / λ      1/s
///   α   `start`: relative change at t = 0, as of a drive that is colder then than when the
///       model's friction was measured                                                    1
///   λ   `settling_rate`: inverse of the time constant; 0: linear in time                 1/s
///   σ   `joint_share`: 1: the joint's bearing warms up like the drive; 0: it does not    1
///   t   time on the log's clock                                                          s
///
/// Source: Bittencourt and Axelsson, IEEE/ASME Trans. Mechatronics 19 (2014), friction over temperature. A body
/// heated at constant power approaches its final temperature exponentially.

namespace halyard::effects {
namespace {

/// Far slower than any motion, and far from where 1 - exp(-λ t) loses its digits.
constexpr double kSlowest = 1e-6;

template <class T>
T growth(const EffectContext<T>& c) {
  const T settling = max(T(kSlowest), c.p[2]);
  return max(T(-1.0), T(c.p[1] + c.p[0] * (T(1.0) - exp(T(T(-std::max(c.time, 0.0)) * settling))) / settling));
}

}  // namespace

class FrictionDrift : public EffectOf<FrictionDrift>, public OneSignalEffect {
 public:
  std::string name() const override { return "friction_drift"; }
  std::string summary() const override { return "friction that changes in time, as of a drive that warms up"; }
  unsigned stages() const override {
    return static_cast<unsigned>(EffectStage::motor) | static_cast<unsigned>(EffectStage::joint);
  }
  /// Others follow what it tells.
  int rank(EffectStage) const override { return -1; }
  Signal signal_at(EffectStage stage) const override {
    return stage == EffectStage::motor ? Signal::motor_rate : Signal::joint_rate;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"rate", "1/s", 0, -0.01, -2, 2},
            {"start", "1", 0, 0.3, -1, 5},
            {"settling_rate", "1/s", 0, 0, 0, 1},
            {"joint_share", "1", 1, 1, 0, 1}};
  }

  template <class T>
  void on_motor(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[*c.joint];
    if (j.drive == Drive::none) return;
    JointSignals<T>& own = s[*c.joint];
    const T g = growth(c);
    own.motor_torque -= g * friction(j.motor_coulomb, j.motor_viscous, j.motor_smoothing, own.motor_rate);
    own.motor_friction_drift += g;
  }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[*c.joint];
    JointSignals<T>& own = s[*c.joint];
    const T g = c.p[3] * growth(c);
    own.joint_force -= g * friction(j.joint_coulomb, j.joint_viscous, j.joint_smoothing, own.joint_rate);
    own.joint_friction_drift += g;
  }
};

HALYARD_EFFECT(FrictionDrift)

}  // namespace halyard::effects

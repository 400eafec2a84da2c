#include "transmission/effects/built_in.h"
#include "transmission/effects/typical_size.h"

/// Torque that saturates below the command. The limit falls with speed if the torque acts in the direction of motion:
///
///   τ' = τ - ρ (τ - clamp(τ, -τ_max h(-ω), τ_max h(ω))),   h(ω) = 1 - ω / ω_0 within [0, 1]
///
///   τ_max   `limit` at standstill                                                      N m
///   ω_0     `no_load_speed`, at which the limit is zero                                rad/s
///   ρ       share of the torque beyond the limit that is lost: 1 for a hard limit       -
///
/// ρ is the size of the effect, the limits are its shape: nothing saturates at ρ = 0. With a no-load speed far above
/// the motion's speeds, the limit does not depend on speed. A torque that the log has measured is not limited any more.
/// Source: the torque-speed line of a motor at constant voltage, and the current limit of its amplifier.

namespace halyard::effects {

class ActuatorSaturation : public EffectOf<ActuatorSaturation> {
 public:
  std::string name() const override { return "actuator_saturation"; }
  std::string summary() const override { return "torque or speed that saturates below the command"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::command); }
  /// The amplifier limits what all others make of the command.
  int rank(EffectStage) const override { return 1; }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    const JointParameters<double>& j = arm.joint[joint];
    return j.drive != Drive::none && j.torque_source == TorqueSource::commanded;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double level = typical_motor_friction(arm.joint[*joint]), no_limit = 1e4;
    return {{"share", "1", 0, 1, 0, 1},
            {"limit", "N m", 4 * level, 4 * level, 0.1 * level, 300 * level},
            {"no_load_speed", "rad/s", no_limit, no_limit, 1, 1e5}};
  }

  template <class T>
  void on_command(const EffectContext<T>& c, JointSignals<T>* s) const {
    JointSignals<T>& own = s[*c.joint];
    const T speed_ratio = own.motor_rate / c.p[2];
    const T forward = c.p[1] * max(T(0.0), min(T(1.0), T(T(1.0) - speed_ratio)));
    const T backward = c.p[1] * max(T(0.0), min(T(1.0), T(T(1.0) + speed_ratio)));
    const T torque = own.motor_torque;
    own.motor_torque -= c.p[0] * (torque - max(T(-backward), min(forward, torque)));
  }
};

HALYARD_EFFECT(ActuatorSaturation)

}  // namespace halyard::effects

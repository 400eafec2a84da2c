#include "transmission/effects/built_in.h"
#include "transmission/effects/one_signal.h"
#include "transmission/effects/typical_size.h"
#include "transmission/friction.h"

/// Friction that falls with speed near standstill, on top of the Coulomb level, at the joint and at its motor:
///
///   F' = F + F_r exp(-(v / v_r)²) tanh(v / v_s)
///
///   F_r   rise over the Coulomb level: `joint_rise`, `motor_rise`       N m | N,  N m
///   v_r   speed at which it has fallen to 1/e: `joint_speed`, ...       rad/s | m/s,  rad/s
///   v_s   the model's smoothing speed                                    as v_r
///
/// A joint without a motor has only `joint_rise` and `joint_speed`.
/// Source: Armstrong-Hélouvry, Dupont and Canudas de Wit, Automatica 30 (1994), the Gaussian form.

namespace halyard::effects {
namespace {

template <class T>
T stribeck(const T& rise, const T& speed, const T& v_s, const T& v) {
  const T u = v / speed;
  return rise * exp(T(-u * u)) * smooth_sign(v, v_s);
}

/// The fall cannot be seen far below the speed of the smoothing: the bounds follow that.
EffectParameter speed(const char* name, const char* unit, double v_s) {
  return {name, unit, 10 * v_s, 10 * v_s, 0.5 * v_s, 300 * v_s};
}

}  // namespace

class Stribeck : public EffectOf<Stribeck>, public OneSignalEffect {
 public:
  std::string name() const override { return "stribeck"; }
  std::string summary() const override { return "friction that falls with speed near standstill"; }
  unsigned stages() const override {
    return static_cast<unsigned>(EffectStage::motor) | static_cast<unsigned>(EffectStage::joint);
  }
  Signal signal_at(EffectStage stage) const override {
    return stage == EffectStage::motor ? Signal::motor_rate : Signal::joint_rate;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const JointParameters<double>& j = arm.joint[*joint];
    const bool turns = j.type == JointType::revolute;
    const double at_joint = typical_joint_friction(j);
    std::vector<EffectParameter> all = {{"joint_rise", turns ? "N m" : "N", 0, 0.5 * at_joint, 0, 10 * at_joint},
                                        speed("joint_speed", turns ? "rad/s" : "m/s", j.joint_smoothing)};
    if (j.drive == Drive::none) return all;
    const double at_motor = typical_motor_friction(j);
    all.push_back({"motor_rise", "N m", 0, 0.5 * at_motor, 0, 10 * at_motor});
    all.push_back(speed("motor_speed", "rad/s", j.motor_smoothing));
    return all;
  }

  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].joint_force -= stribeck(c.p[0], c.p[1], c.arm.joint[*c.joint].joint_smoothing, s[*c.joint].joint_rate);
  }
  template <class T>
  void on_motor(const EffectContext<T>& c, JointSignals<T>* s) const {
    if (c.arm.joint[*c.joint].drive == Drive::none) return;
    s[*c.joint].motor_torque -= stribeck(c.p[2], c.p[3], c.arm.joint[*c.joint].motor_smoothing, s[*c.joint].motor_rate);
  }
};

HALYARD_EFFECT(Stribeck)

}  // namespace halyard::effects

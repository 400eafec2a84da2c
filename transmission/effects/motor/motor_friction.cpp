#include "transmission/effects/built_in.h"
#include "transmission/effects/one_signal.h"
#include "transmission/effects/typical_size.h"
#include "transmission/friction.h"

/// Friction at the motor that differs from the model's, and its asymmetry:
///
///   F' = F + ΔF_c tanh(v / v_s) + ΔF_v v + α F_c' tanh²(v / v_s) + α_v F_v' v tanh(v / v_s)
///
///   ΔF_c, ΔF_v   change of the Coulomb level, of the viscous coefficient    N m, N m s/rad
///   α            asymmetry: the Coulomb level F_c' = F_c + ΔF_c is (1 + α) F_c' forward, (1 - α) F_c' backward
///   α_v          asymmetry of the viscous coefficient F_v' = F_v + ΔF_v in the same way, `viscous_asymmetry`
///
/// Source: the paper's Eq. 5; asymmetry as in Armstrong-Hélouvry et al., Automatica 30 (1994).

namespace halyard::effects {

class MotorFriction : public EffectOf<MotorFriction>, public OneSignalEffect {
 public:
  std::string name() const override { return "motor_friction"; }
  std::string summary() const override { return "another Coulomb or viscous friction at the motor, or its asymmetry"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::motor); }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive != Drive::none;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const JointParameters<double>& j = arm.joint[*joint];
    const double level = typical_motor_friction(j);
    const double viscous = std::max(j.motor_viscous, 0.002 * level);
    return {{"coulomb_change", "N m", 0, 0.3 * level, -j.motor_coulomb, 30 * level},
            {"viscous_change", "N m s/rad", 0, 0.3 * viscous, -j.motor_viscous, 30 * viscous},
            {"asymmetry", "1", 0, 0.1, -1, 1},
            {"viscous_asymmetry", "1", 0, 0.1, -1, 1}};
  }

  template <class T>
  void change(ArmParameters<T>& arm, EffectPlace joint, const T* p) const {
    arm.joint[*joint].motor_coulomb += p[0];
    arm.joint[*joint].motor_viscous += p[1];
  }
  template <class T>
  void on_motor(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[*c.joint];
    const T v = s[*c.joint].motor_rate, sign = smooth_sign(v, j.motor_smoothing);
    s[*c.joint].motor_torque -= (c.p[2] * j.motor_coulomb * sign + c.p[3] * j.motor_viscous * v) * sign;
  }
};

HALYARD_EFFECT(MotorFriction)

}  // namespace halyard::effects

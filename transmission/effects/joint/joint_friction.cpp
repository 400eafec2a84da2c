#include "transmission/effects/built_in.h"
#include "transmission/effects/one_signal.h"
#include "transmission/effects/typical_size.h"
#include "transmission/friction.h"

/// Friction at the joint that differs from the model's, and its asymmetry:
///
///   F' = F + ΔF_c tanh(v / v_s) + ΔF_v v + α F_c' tanh²(v / v_s) + α_v F_v' v tanh(v / v_s)
///
///   ΔF_c, ΔF_v   change of the Coulomb level, of the viscous coefficient    N m | N, N m s/rad | N s/m
///   α            asymmetry: the Coulomb level F_c' = F_c + ΔF_c is (1 + α) F_c' forward, (1 - α) F_c' backward
///   α_v          asymmetry of the viscous coefficient F_v' = F_v + ΔF_v in the same way, `viscous_asymmetry`
///
/// Source: the paper's Eq. 4; asymmetry as in Armstrong-Hélouvry et al., Automatica 30 (1994).

namespace halyard::effects {

class JointFriction : public EffectOf<JointFriction>, public OneSignalEffect {
 public:
  std::string name() const override { return "joint_friction"; }
  std::string summary() const override { return "another Coulomb or viscous friction at the joint, or its asymmetry"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  Signal signal_at(EffectStage) const override { return Signal::joint_rate; }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const JointParameters<double>& j = arm.joint[*joint];
    const bool turns = j.type == JointType::revolute;
    const double level = typical_joint_friction(j);
    const double viscous = std::max(j.joint_viscous, 0.02 * level);
    return {{"coulomb_change", turns ? "N m" : "N", 0, 0.3 * level, -j.joint_coulomb, 30 * level},
            {"viscous_change", turns ? "N m s/rad" : "N s/m", 0, 0.3 * viscous, -j.joint_viscous, 300 * viscous},
            {"asymmetry", "1", 0, 0.1, -1, 1},
            {"viscous_asymmetry", "1", 0, 0.1, -1, 1}};
  }

  template <class T>
  void change(ArmParameters<T>& arm, EffectPlace joint, const T* p) const {
    arm.joint[*joint].joint_coulomb += p[0];
    arm.joint[*joint].joint_viscous += p[1];
  }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[*c.joint];
    const T v = s[*c.joint].joint_rate, sign = smooth_sign(v, j.joint_smoothing);
    s[*c.joint].joint_force -= (c.p[2] * j.joint_coulomb * sign + c.p[3] * j.joint_viscous * v) * sign;
  }
};

HALYARD_EFFECT(JointFriction)

}  // namespace halyard::effects

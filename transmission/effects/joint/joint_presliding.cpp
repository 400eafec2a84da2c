#include "transmission/effects/built_in.h"
#include "transmission/effects/presliding.h"

/// Friction of the joint that is elastic before it slides (presliding.h): F_c, v_s and v are those of the joint.

namespace halyard::effects {

class JointPresliding : public EffectOf<JointPresliding> {
 public:
  std::string name() const override { return "joint_presliding"; }
  std::string summary() const override { return "friction at the joint that is elastic before it slides"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const bool turns = arm.joint[*joint].type == JointType::revolute;
    const double typical = turns ? 5e-3 : 5e-4;
    return {{"share", "1", 0, 0.5, 0, 1},
            {"deflection", turns ? "rad" : "m", typical, typical, 0.04 * typical, 40 * typical}};
  }
  int n_states() const override { return 1; }
  std::vector<double> state_scale(const ArmParameters<double>&, EffectPlace, const double* p) const override {
    return {p[1]};
  }

  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[*c.joint];
    JointSignals<T>& own = s[*c.joint];
    own.joint_force -=
        presliding_force(c.p, j.joint_coulomb, j.joint_smoothing, own.joint_rate, c.z[0], own.joint_friction_drift);
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    z_dot[0] = presliding_rate(c.p, s[*c.joint].joint_rate, c.z[0]);
  }
};

HALYARD_EFFECT(JointPresliding)

}  // namespace halyard::effects

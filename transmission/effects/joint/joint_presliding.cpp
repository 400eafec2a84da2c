#include "transmission/effects/built_in.h"
#include "transmission/effects/typical_size.h"
#include "transmission/friction.h"

/// Friction of the joint that is elastic before it slides. The share ρ of the Coulomb friction follows Dahl's equation
/// instead of the speed:
///
///   F' = F + ρ F_c (z / z_y - tanh(v / v_s)),   z' = v - |v| z / z_y
///
///   z     elastic deflection of the contacts         rad | m
///   z_y   deflection at which they slide: |z| < z_y  rad | m
///   ρ     share of the Coulomb level F_c             -
///
/// After a reversal the friction turns round over an angle of some z_y, however slow the motion. It is passive while ρ
/// is at most one.
/// Source: Dahl, "A solid friction model", Aerospace Corporation TOR-0158 (1968), with the exponent 1; LuGre's equation
/// without its damping (Canudas de Wit et al., IEEE Trans. Automatic Control 40 (1995)).

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
    const T sliding = smooth_sign(s[*c.joint].joint_rate, j.joint_smoothing);
    s[*c.joint].joint_force -= c.p[0] * j.joint_coulomb * (c.z[0] / c.p[1] - sliding);
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    const T v = s[*c.joint].joint_rate;
    z_dot[0] = v - abs(v) * c.z[0] / c.p[1];
  }
};

template std::unique_ptr<const Effect> make_effect<JointPresliding>();

}  // namespace halyard::effects

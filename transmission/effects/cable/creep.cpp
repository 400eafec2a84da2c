#include "transmission/effects/built_in.h"
#include "transmission/effects/typical_size.h"

/// Stretch that grows slowly under load. The cable is a standard linear solid: an elastic part in series with a slow
/// part that follows it with a lag,
///
///   x_e = x - c z,   ż = (x_e - z) / τ,   g = law(x_e, ẋ)
///
///   x_e   elastic stretch, which makes the force      m
///   z     x_e after the lag of the slow part           m
///   c     compliance of the slow part over that of the elastic one, `compliance_share`      -
///   τ     time constant of the slow part at constant force                                   s
///
/// Under a constant force the stretch ends at (1 + c) times its first value. The cable's damper is parallel to both
/// parts.
/// Source: Zener, "Elasticity and Anelasticity of Metals" (1948).

namespace halyard::effects {

class Creep : public EffectOf<Creep> {
 public:
  std::string name() const override { return "creep"; }
  std::string summary() const override { return "stretch that grows slowly under load"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::stretch); }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive == Drive::cable;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"compliance_share", "1", 0, 0.3, 0, 5}, {"time_constant", "s", 3, 3, 0.2, 300}};
  }
  int n_states() const override { return 1; }
  std::vector<double> state_scale(const ArmParameters<double>& arm, EffectPlace joint, const double*) const override {
    return {typical_stretch(arm.joint[*joint])};
  }

  template <class T>
  void on_stretch(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].stretch -= c.p[0] * c.z[0];
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    z_dot[0] = (s[*c.joint].stretch - c.z[0]) / c.p[1];
  }
};

HALYARD_EFFECT(Creep)

}  // namespace halyard::effects

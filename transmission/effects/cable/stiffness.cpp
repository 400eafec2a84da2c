#include "transmission/effects/built_in.h"
#include "transmission/effects/one_signal.h"
#include "transmission/effects/typical_size.h"

/// Stiffness or damping that differs from the model's, or a law that stiffens: k_e' = κ k_e, b_e' = δ b_e,
///
///   g' = g + 2 k_e' β x³
///
///   κ, δ   ratios to the model's numbers                                   -
///   β      `stiffening`: stiffness grows by 3 β x²; at least 0, so that
///          the force grows with stretch everywhere                          1/m²
///
/// Source: the paper's Table I gives one value for a cable whose stiffness varies with tension
/// and wear (Miyasaka et al., ICRA 2016).

namespace halyard::effects {

class Stiffness : public EffectOf<Stiffness>, public OneSignalEffect {
 public:
  std::string name() const override { return "stiffness"; }
  std::string summary() const override { return "another stiffness or damping of the cable, or a stiffening law"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::cable_force); }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive == Drive::cable;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double stretch = typical_stretch(arm.joint[*joint]), stiffening = 1 / (stretch * stretch);
    return {{"stiffness_ratio", "1", 1, 0.8, 0.02, 50},
            {"damping_ratio", "1", 1, 0.8, 0.02, 50},
            {"stiffening", "1/m^2", 0, 0.1 * stiffening, 0, 100 * stiffening}};
  }

  template <class T>
  void change(ArmParameters<T>& arm, EffectPlace joint, const T* p) const {
    arm.joint[*joint].stiffness *= p[0];
    arm.joint[*joint].damping *= p[1];
  }
  template <class T>
  void on_cable_force(const EffectContext<T>& c, JointSignals<T>* s) const {
    const T x = s[*c.joint].stretch, change = T(2.0) * c.arm.joint[*c.joint].stiffness * c.p[2] * x * x * x;
    s[*c.joint].cable_force_motor += change;
    s[*c.joint].cable_force_joint += change;
  }
};

HALYARD_EFFECT(Stiffness)

}  // namespace halyard::effects

#include "transmission/effects/built_in.h"

/// A transmission ratio from motor to cable that differs from the model's: r_m' = κ r_m. Capstan, gear and link pulley
/// enter a joint's motion through one ratio only, so κ covers errors of all three.
///
///   κ   ratio to the model's capstan radius      -
///
/// Source: the effective capstan radius is the core's radius plus half the cable's diameter. The paper's Table I omits
/// the half diameter.

namespace halyard::effects {

class CapstanRatio : public EffectOf<CapstanRatio> {
 public:
  std::string name() const override { return "capstan_ratio"; }
  std::string summary() const override { return "another transmission ratio from motor to cable"; }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive != Drive::none;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"ratio", "1", 1, 1.02, 0.5, 2}};
  }

  template <class T>
  void change(ArmParameters<T>& arm, EffectPlace joint, const T* p) const {
    arm.joint[*joint].capstan_radius *= p[0];
  }
};

HALYARD_EFFECT(CapstanRatio)

}  // namespace halyard::effects

#include "transmission/effects/built_in.h"

/// Another transmission ratio from motor to cable: r_m' = κ r_m. The capstan, the gear and the link
/// pulley enter a joint's motion through one ratio only, so it stands for all three.
///
///   κ   ratio to the model's capstan radius      -
///
/// Source: an effective capstan radius is the core's plus half the cable's diameter, which the
/// paper's Table I does not add.

namespace halyard::effects {

class CapstanRatio : public EffectOf<CapstanRatio> {
 public:
  std::string name() const override { return "capstan_ratio"; }
  std::string summary() const override { return "another transmission ratio from motor to cable"; }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive != Drive::none;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, int) const override {
    return {{"ratio", "1", 1, 1.02, 0.5, 2}};
  }

  template <class T>
  void change(ArmParameters<T>& arm, int joint, const T* p) const {
    arm.joint[joint].capstan_radius *= p[0];
  }
};

template std::unique_ptr<const Effect> make_effect<CapstanRatio>();

}  // namespace halyard::effects

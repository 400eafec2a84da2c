#include "transmission/effects/built_in.h"
#include "transmission/effects/typical_size.h"

/// A dead zone in the path from motor to joint: the cable is stretched only beyond the gap,
///
///   x_eff = x - min(max(x, -h), h),   x'_eff = x' outside the gap, 0 inside
///
///   h   half of the gap     m
///
/// Source: Nordin and Gutman, "Controlling mechanical systems with backlash", Automatica 38 (2002),
/// dead-zone model with a damped shaft.

namespace halyard::effects {

class Backlash : public EffectOf<Backlash> {
 public:
  std::string name() const override { return "backlash"; }
  std::string summary() const override { return "a dead zone in the path from motor to joint"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::stretch); }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive == Drive::cable;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    // A gap of a cable is some hundredths of its capstan. A gear's, with a radius of 1, is about what its teeth yield.
    constexpr double kOfRadius = 0.03, kOfStretch = 10;
    const JointParameters<double>& j = arm.joint[*joint];
    const double typical = std::min(kOfRadius * j.capstan_radius, kOfStretch * typical_stretch(j));
    return {{"half_gap", "m", 0, typical, 0, 2 * j.capstan_radius}};
  }

  template <class T>
  void on_stretch(const EffectContext<T>& c, JointSignals<T>* s) const {
    JointSignals<T>& own = s[*c.joint];
    const T inside = min(max(own.stretch, T(-c.p[0])), c.p[0]);
    own.stretch_rate = select(abs(own.stretch) >= c.p[0], own.stretch_rate, T(0.0));
    own.stretch -= inside;
  }
};

template std::unique_ptr<const Effect> make_effect<Backlash>();

}  // namespace halyard::effects

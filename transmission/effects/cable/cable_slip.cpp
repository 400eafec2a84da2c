#include "transmission/effects/built_in.h"
#include "transmission/effects/one_signal.h"
#include "transmission/effects/smooth_step.h"

/// A lasting offset between motor and joint, because the cable slips on its capstan:
///
///   x' = x - Δ s(t - t_0)
///
///   Δ     length that slips, `jump`                                       m
///   t_0   instant of half the slip, `time`, on the log's clock             s
///   s     smooth step of the width 10 ms + T, see smooth_step.h
///   T     `duration`: 0 if it slips at once, as over a sudden load. A cable that slips under its working tension
///         creeps from the edge of its contact on (Johnson, Contact Mechanics, 1985, section 8.1)          s
///
/// The length that slips does not return. The rate of the slip is part of the stretch rate ẋ.

namespace halyard::effects {

class CableSlip : public EffectOf<CableSlip>, public OneSignalEffect {
 public:
  std::string name() const override { return "cable_slip"; }
  std::string summary() const override {
    return "a lasting jump of the motor-to-joint relation, sudden or within seconds";
  }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::stretch); }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive == Drive::cable;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double radius = arm.joint[*joint].capstan_radius;
    return {{"jump", "m", 0, 0.03 * radius, -2 * radius, 2 * radius},
            {"time", "s", 1, 1, -1e10, 1e10},
            {"duration", "s", 0, 0, 0, 3}};
  }

  template <class T>
  void on_stretch(const EffectContext<T>& c, JointSignals<T>* s) const {
    const SmoothStep<T> step = smooth_step(c.time, c.p[1], T(T(kStepWidth) + c.p[2]));
    s[*c.joint].stretch -= c.p[0] * step.value;
    s[*c.joint].stretch_rate -= c.p[0] * step.rate;
  }
};

HALYARD_EFFECT(CableSlip)

}  // namespace halyard::effects

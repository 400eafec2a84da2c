#include "transmission/effects/built_in.h"
#include "transmission/effects/one_signal.h"
#include "transmission/effects/typical_size.h"

/// A dead zone in the path from motor to joint: the cable is stretched only beyond the gap,
///
///   x_eff = e(x - h) - e(-x - h),   e(u) = (u + √(u² + ρ²)) / 2,   x'_eff = x' ∂x_eff/∂x
///
///   h   half of the gap                                             m
///   ρ   rounding of its edges: at an edge, x_eff is ρ / 2. With ρ = 0 the cable is slack up to the edge, and
///       x_eff = x - min(max(x, -h), h)                              m
///
/// Where the sides meet, they yield before they carry the whole load.
/// Source: Nordin and Gutman, "Controlling mechanical systems with backlash", Automatica 38 (2002),
/// dead-zone model with a damped shaft; the hyperbola is the usual smooth form of |x|.

namespace halyard::effects {

class Backlash : public EffectOf<Backlash>, public OneSignalEffect {
 public:
  std::string name() const override { return "backlash"; }
  std::string summary() const override { return "a dead zone in the path from motor to joint"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::stretch); }
  /// What the others add to the stretch moves the cable within the gap; nothing stretches it there.
  int rank(EffectStage) const override { return 1; }
  bool has_kinks() const override { return true; }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive == Drive::cable;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const JointParameters<double>& j = arm.joint[*joint];
    const double typical = typical_half_gap(j);
    return {{"half_gap", "m", 0, typical, 0, 2 * j.capstan_radius}, {"rounding", "m", 0, 0, 0, typical}};
  }

  template <class T>
  void on_stretch(const EffectContext<T>& c, JointSignals<T>* s) const {
    JointSignals<T>& own = s[*c.joint];
    // Of each edge: positive where the cable is stretched beyond it. In sums, so that both vanish within a sharp gap.
    const T forward = own.stretch - c.p[0], backward = -own.stretch - c.p[0];
    const T f = hyperbola(forward, c.p[1]), b = hyperbola(backward, c.p[1]);
    own.stretch = T(0.5) * ((forward + f) - (backward + b));
    own.stretch_rate *= T(0.5) * ((T(1.0) + forward / f) + (T(1.0) + backward / b));
  }

 private:
  /// √(x² + ρ²), with a derivative also at 0.
  template <class T>
  static T hyperbola(const T& x, const T& rounding) {
    constexpr double kSharpest = 1e-18;  // m
    return sqrt(T(x * x + rounding * rounding + T(kSharpest * kSharpest)));
  }
};

HALYARD_EFFECT(Backlash)

}  // namespace halyard::effects

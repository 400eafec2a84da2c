#include "transmission/effects/built_in.h"
#include "transmission/effects/harmonic.h"

/// A ratio that varies with the capstan's angle θ = q_m / N, as with a capstan whose axis is off its centre:
///
///   x' = x + r_m (e_c sin θ + e_s (1 - cos θ)),   motor's lever ∂x'/∂θ = r_m (1 + e_c cos θ + e_s sin θ)
///
///   e_c, e_s   `cosine` and `sine` of the variation, relative to the radius      -
///
/// The cable pulls the motor with the same lever with which the motor stretches the cable, so no power is lost.
/// Source: geometry, to first order in the eccentricity. The error is zero at q_m = 0, the origin of the motor's angle.

namespace halyard::effects {

class CapstanEccentricity : public EffectOf<CapstanEccentricity> {
 public:
  std::string name() const override { return "capstan_eccentricity"; }
  std::string summary() const override { return "a transmission ratio that varies with the capstan's angle"; }
  unsigned stages() const override {
    return static_cast<unsigned>(EffectStage::stretch) | static_cast<unsigned>(EffectStage::cable_force);
  }
  /// The lever of the capstan multiplies the force that all others leave.
  int rank(EffectStage stage) const override { return stage == EffectStage::cable_force ? 3 : 0; }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive == Drive::cable;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"cosine", "1", 0, 0.02, -0.3, 0.3}, {"sine", "1", 0, 0.02, -0.3, 0.3}};
  }

  template <class T>
  void on_stretch(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[*c.joint];
    JointSignals<T>& own = s[*c.joint];
    T sine, cosine;
    sin_cos(T(own.motor_angle / j.gear_ratio), sine, cosine);
    own.stretch += j.capstan_radius * (c.p[0] * sine + c.p[1] * (T(1.0) - cosine));
    own.stretch_rate += j.motor_travel() * (c.p[0] * cosine + c.p[1] * sine) * own.motor_rate;
  }
  template <class T>
  void on_cable_force(const EffectContext<T>& c, JointSignals<T>* s) const {
    const T theta = s[*c.joint].motor_angle / c.arm.joint[*c.joint].gear_ratio;
    s[*c.joint].cable_force_motor *= T(1.0) + harmonic(c.p[0], c.p[1], theta);
  }
};

HALYARD_EFFECT(CapstanEccentricity)

}  // namespace halyard::effects

#include "transmission/effects/built_in.h"
#include "transmission/effects/harmonic.h"

/// A joint sensor's error that is periodic in the joint's position:
///
///   reading = q + A_c cos(k q) + A_s sin(k q)
///
///   A_c, A_s   `cosine`, `sine`                                                       rad | m
///   k          periods a turn, `order` | wave number of a scale, `wave_number`         - | rad/m
///
/// Source: a disc of radius R whose centre is off its axis by e has an error of amplitude e / R once a turn. Two
/// reading heads, interpolation errors and the scale of a linear encoder give higher orders.

namespace halyard::effects {

class EncoderEccentricity : public EffectOf<EncoderEccentricity> {
 public:
  std::string name() const override { return "encoder_eccentricity"; }
  std::string summary() const override { return "a joint encoder error periodic in its angle"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::sensors); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    if (arm.joint[*joint].type == JointType::revolute)
      return {
          {"cosine", "rad", 0, 2e-3, -0.2, 0.2}, {"sine", "rad", 0, 2e-3, -0.2, 0.2}, {"order", "1", 1, 1, 0.5, 64}};
    return {{"cosine", "m", 0, 2e-4, -0.02, 0.02},
            {"sine", "m", 0, 2e-4, -0.02, 0.02},
            {"wave_number", "rad/m", 200, 200, 5, 5000}};
  }

  template <class T>
  void on_sensors(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].joint_error += harmonic(c.p[0], c.p[1], T(c.p[2] * s[*c.joint].joint_position));
  }
};

HALYARD_EFFECT(EncoderEccentricity)

}  // namespace halyard::effects

#include "transmission/cable_law.h"
#include "transmission/effects/built_in.h"
#include "transmission/effects/typical_size.h"

/// Rate-independent hysteresis of the cable's force over its stretch, of Bouc-Wen type. The share ρ of the stiffness
/// belongs to an element that yields:
///
///   g' = g + ρ (2 k_e z - g(x, 0)),   ż = ẋ - |ẋ| z / z_y  where ẋ z > 0,   ż = ẋ  elsewhere
///
///   g(x, 0)   the law without damping, in which a slack run does not pull; 2 k_e x under the paper's      N
///   z     elastic stretch of the element that yields       m
///   z_y   stretch at which it yields: |z| < z_y             m
///   ρ     its share of the stiffness                        -
///
/// This is Bouc-Wen with n = 1, β = γ = 1 / (2 z_y). It is passive. A repeated cycle of stretch becomes a closed loop.
/// The element is loaded by the motion of motor and joint, and by a slip, not by the slow stretch of `creep`.
/// Source: Wen, J. Eng. Mech. 102 (1976); for robot cables Miyasaka et al., ICRA 2016.

namespace halyard::effects {

class Hysteresis : public EffectOf<Hysteresis> {
 public:
  std::string name() const override { return "hysteresis"; }
  std::string summary() const override { return "a rate-independent loop of the cable's force over its stretch"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::cable_force); }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive == Drive::cable;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double stretch = typical_stretch(arm.joint[*joint]);
    // A loop that yields earlier is a softer cable: stretch changes by more than that from one sample to the next.
    const double least = 2e-3 * stretch;
    return {{"share", "1", 0, 0.4, 0, 0.95}, {"yield_stretch", "m", 0.1 * stretch, 0.1 * stretch, least, 10 * stretch}};
  }
  int n_states() const override { return 1; }
  std::vector<double> state_scale(const ArmParameters<double>&, EffectPlace, const double* p) const override {
    return {p[1]};
  }

  template <class T>
  void on_cable_force(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[*c.joint];
    JointSignals<T>& own = s[*c.joint];
    const T change = j.law == CableLaw::paper
                         ? T(T(2.0) * j.stiffness * c.p[0] * (c.z[0] - own.stretch))
                         : T(c.p[0] * (T(2.0) * j.stiffness * c.z[0] - cable_force(j, own.stretch, T(0.0))));
    own.cable_force_motor += change;
    own.cable_force_joint += change;
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    const T rate = s[*c.joint].stretch_rate;
    const T loading = rate * c.z[0];
    z_dot[0] = rate - select(loading > T(0.0), T(abs(rate) * c.z[0] / c.p[1]), T(0.0));
  }
};

HALYARD_EFFECT(Hysteresis)

}  // namespace halyard::effects

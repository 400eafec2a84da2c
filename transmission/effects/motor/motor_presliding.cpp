#include "transmission/effects/built_in.h"
#include "transmission/effects/typical_size.h"
#include "transmission/friction.h"

/// Friction of the motor that is elastic before it slides. The share ρ of the Coulomb friction follows Dahl's equation
/// instead of the speed:
///
///   F' = F + ρ F_c (z / z_y - tanh(v / v_s)),   z' = v - |v| z / z_y
///
///   z     elastic deflection of the contacts         rad
///   z_y   deflection at which they slide: |z| < z_y  rad
///   ρ     share of the Coulomb level F_c             -
///
/// After a reversal the friction turns round over an angle of some z_y, however slow the motion. It is passive while ρ
/// is at most one.
/// Source: Dahl, "A solid friction model", Aerospace Corporation TOR-0158 (1968), with the exponent 1; LuGre's equation
/// without its damping (Canudas de Wit et al., IEEE Trans. Automatic Control 40 (1995)).

namespace halyard::effects {

class MotorPresliding : public EffectOf<MotorPresliding> {
 public:
  std::string name() const override { return "motor_presliding"; }
  std::string summary() const override { return "friction at the motor that is elastic before it slides"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::motor); }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive != Drive::none;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"share", "1", 0, 0.5, 0, 1}, {"deflection", "rad", 0.3, 0.3, 0.02, 6}};
  }
  int n_states() const override { return 1; }
  std::vector<double> state_scale(const ArmParameters<double>&, EffectPlace, const double* p) const override {
    return {p[1]};
  }

  template <class T>
  void on_motor(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[*c.joint];
    const T sliding = smooth_sign(s[*c.joint].motor_rate, j.motor_smoothing);
    s[*c.joint].motor_torque -= c.p[0] * j.motor_coulomb * (c.z[0] / c.p[1] - sliding);
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    const T v = s[*c.joint].motor_rate;
    z_dot[0] = v - abs(v) * c.z[0] / c.p[1];
  }
};

template std::unique_ptr<const Effect> make_effect<MotorPresliding>();

}  // namespace halyard::effects

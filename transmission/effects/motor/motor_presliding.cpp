#include "transmission/effects/built_in.h"
#include "transmission/effects/presliding.h"

/// Friction of the motor that is elastic before it slides (presliding.h): F_c, v_s and v are those of the motor.

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
    JointSignals<T>& own = s[*c.joint];
    own.motor_torque -=
        presliding_force(c.p, j.motor_coulomb, j.motor_smoothing, own.motor_rate, c.z[0], own.motor_friction_drift);
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    z_dot[0] = presliding_rate(c.p, s[*c.joint].motor_rate, c.z[0]);
  }
};

HALYARD_EFFECT(MotorPresliding)

}  // namespace halyard::effects

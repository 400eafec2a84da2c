#include "transmission/effects/library.h"
#include "transmission/friction.h"

/// Friction that changes in time, as of a drive that warms up: Coulomb level and viscous coefficient, of motor and
/// joint, all times
///
///   max(0, 1 + ρ τ (1 - exp(-t / τ))),   t >= 0
///
///   ρ   `rate`, the relative change per time at the start; in the end it is ρ τ      1/s
///   τ   `time_constant`; much longer than a record: a change linear in time          s
///   t   on the log's clock                                                            s
///
/// Source: Bittencourt and Axelsson, IEEE/ASME Trans. Mechatronics 19 (2014), friction over temperature; a body that
/// warms at constant power settles exponentially.

namespace halyard {
namespace {

template <class T>
T growth(const EffectContext<T>& c) {
  return max(T(-1.0), T(c.p[0] * c.p[1] * (T(1.0) - exp(T(T(-std::max(c.time, 0.0)) / c.p[1])))));
}

class FrictionDrift : public EffectOf<FrictionDrift> {
 public:
  std::string name() const override { return "friction_drift"; }
  std::string summary() const override { return "friction that changes in time, as of a drive that warms up"; }
  unsigned stages() const override {
    return static_cast<unsigned>(EffectStage::motor) | static_cast<unsigned>(EffectStage::joint);
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, int) const override {
    return {{"rate", "1/s", 0, -0.01, -2, 2, 0},
            {"time_constant", "s", 30, 30, 1, 1e4, 0, false, {3, 10, 30, 1000}}};
  }

  template <class T>
  void on_motor(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[c.joint];
    if (j.drive == Drive::none) return;
    s[c.joint].motor_torque -=
        growth(c) * friction(j.motor_coulomb, j.motor_viscous, j.motor_smoothing, s[c.joint].motor_rate);
  }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[c.joint];
    s[c.joint].joint_force -=
        growth(c) * friction(j.joint_coulomb, j.joint_viscous, j.joint_smoothing, s[c.joint].joint_rate);
  }
};

}  // namespace

std::unique_ptr<const Effect> make_friction_drift() { return std::make_unique<FrictionDrift>(); }

}  // namespace halyard

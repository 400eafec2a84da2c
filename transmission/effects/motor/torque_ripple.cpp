#include "transmission/effects/built_in.h"
#include "transmission/effects/harmonic.h"
#include "transmission/effects/one_signal.h"
#include "transmission/effects/typical_size.h"

/// Motor torque that is periodic in the motor's angle (cogging, commutation):
///
///   τ' = τ + A_c cos(n q_m) + A_s sin(n q_m)
///
///   A_c, A_s   `cosine`, `sine`                    N m
///   n          periods a turn of the shaft          -
///
/// The ripple has a potential: it does no work over a whole turn.
/// Source: Holtz and Springob, "Identification and compensation of torque ripple in high-precision permanent magnet
/// motor drives", IEEE Trans. Ind. Electron. 43 (1996).

namespace halyard::effects {

class TorqueRipple : public EffectOf<TorqueRipple>, public OneSignalEffect {
 public:
  std::string name() const override { return "torque_ripple"; }
  std::string summary() const override { return "motor torque periodic in the motor's angle"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::motor); }
  Signal signal_at(EffectStage) const override { return Signal::motor_angle; }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive != Drive::none;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double level = typical_motor_friction(arm.joint[*joint]);
    return {{"cosine", "N m", 0, 0.2 * level, -30 * level, 30 * level},
            {"sine", "N m", 0, 0.2 * level, -30 * level, 30 * level},
            {"order", "1", 12, 12, 0.5, 100}};
  }

  template <class T>
  void on_motor(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].motor_torque += harmonic(c.p[0], c.p[1], T(c.p[2] * s[*c.joint].motor_angle));
  }
};

HALYARD_EFFECT(TorqueRipple)

}  // namespace halyard::effects

#include "transmission/effects/built_in.h"

/// A time shift, at one joint or at all joints alike:
///
///   τ(t) = scale · command(t - d_c) + bias           the torque acts late
///   joint reading(t) = q(t) - d_s q'(t) + d_s² q''(t) / 2      the joint's sensor lags the motor's
///
///   d_c   `command_delay`, at least 0                       s
///   d_s   `sensor_delay`; negative: the motor's lags        s
///
/// Delays of the arm and of a joint add up. The sensor's delay is a second-order approximation, good while d_s is short
/// against the motion. Without a history of commands the torque acts at once. It acts before all other effects that
/// change the commanded torque.

namespace halyard::effects {

class Delay : public EffectOf<Delay> {
 public:
  std::string name() const override { return "delay"; }
  std::string summary() const override { return "a time shift between command and action, or between two sensors"; }
  EffectScope scope() const override { return EffectScope::either; }
  unsigned stages() const override {
    return static_cast<unsigned>(EffectStage::command) | static_cast<unsigned>(EffectStage::sensors);
  }
  /// What is late is the command, and not what becomes of it.
  int rank(EffectStage stage) const override { return stage == EffectStage::command ? -1 : 0; }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"command_delay", "s", 0, 0.005, 0, 0.05}, {"sensor_delay", "s", 0, 0.005, -0.05, 0.05}};
  }

  template <class T>
  void change(ArmParameters<T>& arm, EffectPlace joint, const T* p) const {
    for (int k = first(joint); k < end(joint, arm.n); ++k)
      arm.joint[k].command_delay += p[0], arm.joint[k].sensor_delay += p[1];
  }
  /// Of several delays, each adds its share of what their sum changes.
  template <class T>
  void on_command(const EffectContext<T>& c, JointSignals<T>* s) const {
    if (!c.history) return;
    for (int k = first(c.joint); k < end(c.joint, c.arm.n); ++k) {
      const T whole = c.arm.joint[k].command_delay, share = c.p[0] / whole;
      // Exactly none without a delay: the history is rounded.
      const T late =
          select(c.p[0] > T(0.0), T(share * (c.history->at(k, T(T(c.time) - whole)) - s[k].command)), T(0.0));
      s[k].motor_torque += c.arm.joint[k].torque_scale * late;
    }
  }
  template <class T>
  void on_sensors(const EffectContext<T>& c, JointSignals<T>* s) const {
    for (int k = first(c.joint); k < end(c.joint, c.arm.n); ++k)
      s[k].joint_error -= c.p[1] * (s[k].joint_rate - T(0.5) * c.arm.joint[k].sensor_delay * s[k].joint_acceleration);
  }

 private:
  static int first(EffectPlace joint) { return joint.value_or(0); }
  static int end(EffectPlace joint, int n) { return joint ? *joint + 1 : n; }
};

HALYARD_EFFECT(Delay)

}  // namespace halyard::effects

#include <numbers>

#include "bench/diagnosis/forms/unregistered.h"
#include "transmission/effects/typical_size.h"

/// Motors and loads of other forms than the library's.

namespace halyard::blind {
namespace {

/// A torque that saturates gradually instead of at a limit:
///   τ = L tanh(τ_c / L),  told by 1 / L
/// Source: saturation of a motor's iron, whose magnetisation curve is commonly fitted by tanh.
class GradualSaturation : public EffectOf<GradualSaturation> {
 public:
  std::string name() const override { return "gradual_saturation"; }
  std::string summary() const override { return "a motor torque that saturates gradually"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::command); }
  int rank(EffectStage) const override { return 1; }  // as actuator_saturation
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_motor(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double one_over = 1 / (6 * typical_motor_friction(arm.joint[*joint]));
    return {{"one_over_limit", "1/(N m)", 0, one_over, 0, 10 * one_over}};
  }
  template <class T>
  void on_command(const EffectContext<T>& c, JointSignals<T>* s) const {
    const T p = max(c.p[0], T(1e-9));
    s[*c.joint].motor_torque = tanh(T(p * s[*c.joint].motor_torque)) / p;
  }
};

/// A current loop of first order instead of a dead time:
///   τ = scale · i + bias,   i' = (τ_c - i) / T
/// Source: the closed current loop of a drive is commonly reduced to its dominant pole; Leonhard, Control of Electrical
/// Drives (2001), section 7.
class CurrentLoop : public EffectOf<CurrentLoop>, public PlannedAs {
 public:
  std::string name() const override { return "current_loop"; }
  std::string summary() const override { return "a motor torque that follows its command with a lag of first order"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::command); }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_motor(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"time", "s", 0, 0.005, 0, 0.05}};
  }
  int n_states() const override { return 1; }
  PlacedEffect planned_as(const PlacedEffect& effect, const ArmParameters<double>& arm) const override {
    PlacedEffect delay = place_neutral_effect(*find_effect("delay"), arm, effect.joint);
    delay.p[0] = effect.p[0];
    return delay;
  }
  template <class T>
  void on_command(const EffectContext<T>& c, JointSignals<T>* s) const {
    const T share = min(T(1.0), T(c.p[0] / T(kShortest)));
    s[*c.joint].motor_torque += share * c.arm.joint[*c.joint].torque_scale * (c.z[0] - s[*c.joint].command);
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    z_dot[0] = (s[*c.joint].command - c.z[0]) / max(c.p[0], T(kShortest));
  }

 private:
  /// s. Shorter lags act as a share of this one, which delays a slow torque by as much. Lags that are drawn are longer.
  static constexpr double kShortest = 0.002;
};

/// A load on the joint that swells and fades as half a sine, instead of a rectangle:
///   F = A sin(π (t - t_0) / d)  from t_0 to t_0 + d
/// Source: the half-sine pulse of impact and shock testing, IEC 60068-2-27.
class HalfSineLoad : public EffectOf<HalfSineLoad>, public RefinesSearch {
 public:
  std::string name() const override { return "half_sine_load"; }
  std::string summary() const override { return "a force on the joint that swells and fades as half a sine"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double level = typical_joint_friction(arm.joint[*joint]);
    return {
        {"force", arm.joint[*joint].type == JointType::revolute ? "N m" : "N", 0, 2 * level, -60 * level, 60 * level},
        {"start", "s", 1, 1, -1e10, 1e10},
        {"duration", "s", 3, 3, 0.5, 10}};
  }
  void refine_search(SearchSpace& space, const ArmParameters<double>&, EffectPlace) const override {
    space["start"].range = SearchRange::record_time;
  }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    const T u = max(T(0.0), min(T(1.0), T((T(c.time) - c.p[1]) / c.p[2])));
    s[*c.joint].joint_force += c.p[0] * sin(T(T(std::numbers::pi) * u));
  }
};

/// A torque ripple that has a second harmonic:
///   τ = τ_c + a cos(n q_m) + b sin(n q_m) + 0.4 a sin(2 n q_m)
/// Source: Holtz and Springob, IEEE Trans. Industrial Electronics 43 (1996), harmonics of permanent-magnet motors.
class RippleWithHarmonic : public EffectOf<RippleWithHarmonic>, public RefinesSearch {
 public:
  std::string name() const override { return "ripple_with_harmonic"; }
  std::string summary() const override { return "a motor torque periodic in the motor angle, with a second harmonic"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::command); }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_motor(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double level = typical_motor_friction(arm.joint[*joint]);
    return {{"cosine", "N m", 0, 0.5 * level, -20 * level, 20 * level},
            {"sine", "N m", 0, 0.5 * level, -20 * level, 20 * level},
            {"order", "1", 2, 2, 0.5, 100}};
  }
  void refine_search(SearchSpace& space, const ArmParameters<double>&, EffectPlace) const override {
    space["order"].starts = {1, 2, 3, 4, 6};
  }
  template <class T>
  void on_command(const EffectContext<T>& c, JointSignals<T>* s) const {
    const T u = c.p[2] * s[*c.joint].motor_angle;
    s[*c.joint].motor_torque += c.p[0] * cos(u) + c.p[1] * sin(u) + T(0.4) * c.p[0] * sin(T(T(2.0) * u));
  }
};

}  // namespace

void add_motor_forms(OwnedEffects& to) {
  to.push_back({std::make_unique<GradualSaturation>(), "actuator_saturation"});
  to.push_back({std::make_unique<CurrentLoop>(), "delay"});
  to.push_back({std::make_unique<HalfSineLoad>(), "external_force"});
  to.push_back({std::make_unique<RippleWithHarmonic>(), "torque_ripple"});
}

}  // namespace halyard::blind

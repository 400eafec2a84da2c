#include <numbers>

#include "bench/diagnosis/forms/unregistered.h"
#include "transmission/effects/typical_size.h"
#include "transmission/friction.h"

/// Effects that no candidate of the library describes.

namespace halyard::blind {
namespace {

/// The command of the next joint's amplifier leaks into this one's: τ = τ_c + a τ_c,other.
class TorqueCrosstalk : public EffectOf<TorqueCrosstalk> {
 public:
  std::string name() const override { return "torque_crosstalk"; }
  std::string summary() const override { return "the command of the next joint leaks into this one's motor"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::command); }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.n > 1 && has_motor(arm, joint) && has_motor(arm, (joint + 1) % arm.n);
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"share", "1", 0, 0.3, -2, 2}};
  }
  template <class T>
  void on_command(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].motor_torque += c.p[0] * s[(*c.joint + 1) % c.arm.n].command;
  }
};

/// Two cables share a guide: the motor of the next joint drags this one along, τ = τ + a sign(v_other).
class SharedGuide : public EffectOf<SharedGuide> {
 public:
  std::string name() const override { return "shared_guide"; }
  std::string summary() const override { return "the next joint's cable drags this one's along"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::motor); }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.n > 1 && has_motor(arm, joint) && has_motor(arm, (joint + 1) % arm.n);
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double level = typical_motor_friction(arm.joint[*joint]);
    return {{"drag", "N m", 0, 0.5 * level, -10 * level, 10 * level}};
  }
  template <class T>
  void on_motor(const EffectContext<T>& c, JointSignals<T>* s) const {
    const int other = (*c.joint + 1) % c.arm.n;
    s[*c.joint].motor_torque += c.p[0] * smooth_sign(s[other].motor_rate, c.arm.joint[other].motor_smoothing);
  }
};

/// Friction of a joint that depends on where it stands: F = F + A sin(2π q / λ + φ) sign(v), A up to the level.
class PositionFriction : public EffectOf<PositionFriction>, public RefinesSearch {
 public:
  std::string name() const override { return "position_friction"; }
  std::string summary() const override { return "friction at the joint that depends on its position"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const bool turns = arm.joint[*joint].type == JointType::revolute;
    const double level = typical_joint_friction(arm.joint[*joint]), period = turns ? 0.25 : 0.05;
    return {{"amplitude", turns ? "N m" : "N", 0, 0.5 * level, -level, level},
            {"period", turns ? "rad" : "m", period, period, 0.2 * period, 5 * period}};
  }
  void refine_search(SearchSpace& space, const ArmParameters<double>&, EffectPlace) const override {
    space["amplitude"].natural_bounds = true;
  }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].joint_force -= c.p[0] * sin(T(T(2 * std::numbers::pi) * s[*c.joint].joint_position / c.p[1])) *
                               smooth_sign(s[*c.joint].joint_rate, c.arm.joint[*c.joint].joint_smoothing);
  }
};

/// A mass that hangs on the joint by a soft spring and swings: with u where it is,
///   F = F - m (ω² d + 2 ζ ω (q' - w)),   d = q - u,   d' = q' - w,   w' = ω² d + 2 ζ ω (q' - w),   ζ = 0.05
class SwingingMass : public EffectOf<SwingingMass> {
 public:
  std::string name() const override { return "swinging_mass"; }
  std::string summary() const override { return "a mass that swings on the joint"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const JointParameters<double>& j = arm.joint[*joint];
    const bool turns = j.type == JointType::revolute;
    const double arm_length = turns ? std::hypot(j.com[0], j.com[1], j.com[2]) : 1;
    const double inertia = j.mass * arm_length * arm_length;
    return {{"inertia", turns ? "kg m^2" : "kg", 0, inertia, 0, 30 * inertia},
            {"angular_frequency", "rad/s", 9, 9, 4, 20}};
  }
  int n_states() const override { return 2; }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].joint_force -= c.p[0] * acceleration(c, s);
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    z_dot[0] = s[*c.joint].joint_rate - c.z[1];
    z_dot[1] = acceleration(c, s);
  }

 private:
  template <class T>
  static T acceleration(const EffectContext<T>& c, const JointSignals<T>* s) {
    constexpr double kDamping = 0.05;
    return c.p[1] * c.p[1] * c.z[0] + T(2 * kDamping) * c.p[1] * (s[*c.joint].joint_rate - c.z[1]);
  }
};

/// The joint's sensor wanders: a Brownian motion of deviation σ after 20 s, by the first terms of its expansion of
/// Karhunen and Loeve, e = σ √2 Σ Z_i sin((i - ½) π t / 20 s) / ((i - ½) π).
class WanderingSensor : public EffectOf<WanderingSensor> {
 public:
  std::string name() const override { return "wandering_sensor"; }
  std::string summary() const override { return "a joint sensor that wanders"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::sensors); }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_motor(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double size = arm.joint[*joint].type == JointType::revolute ? 0.01 : 0.002;
    std::vector<EffectParameter> all = {
        {"deviation", arm.joint[*joint].type == JointType::revolute ? "rad" : "m", 0, size, -100 * size, 100 * size}};
    for (int i = 1; i <= kTerms; ++i) all.push_back({"term_" + std::to_string(i), "1", 1, 1, -3, 3});
    return all;
  }
  template <class T>
  void on_sensors(const EffectContext<T>& c, JointSignals<T>* s) const {
    constexpr double kSpan = 20;
    T sum = 0.0;
    for (int i = 1; i <= kTerms; ++i) {
      const double w = (i - 0.5) * std::numbers::pi;
      // Signs that alternate irregularly: equal ones would give a smooth bump at the start.
      sum += c.p[i] * T((i % 3 == 2 ? -1 : 1) * std::numbers::sqrt2 * std::sin(w * c.time / kSpan) / w);
    }
    s[*c.joint].joint_error += c.p[0] * sum;
  }

 private:
  static constexpr int kTerms = kMaxEffectParameters - 1;
};

/// A joint sensor whose gain is another one on either side of a position: e = a |q - q_0|.
class KinkedSensor : public EffectOf<KinkedSensor>, public RefinesSearch {
 public:
  std::string name() const override { return "kinked_sensor"; }
  std::string summary() const override { return "a joint sensor with another gain on either side of a position"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::sensors); }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_motor(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    return {{"gain", "1", 0, 0.05, -0.5, 0.5},
            {"position", arm.joint[*joint].type == JointType::revolute ? "rad" : "m", 0, 0, -10, 10}};
  }
  void refine_search(SearchSpace& space, const ArmParameters<double>&, EffectPlace) const override {
    space["position"].range = SearchRange::joint_position;
  }
  template <class T>
  void on_sensors(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].joint_error += c.p[0] * abs(T(s[*c.joint].joint_position - c.p[1]));
  }
};

/// Drag that grows with the square of the speed: F = F - c q' |q'|.
class QuadraticDrag : public EffectOf<QuadraticDrag> {
 public:
  std::string name() const override { return "quadratic_drag"; }
  std::string summary() const override { return "drag at the joint that grows with the square of the speed"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const bool turns = arm.joint[*joint].type == JointType::revolute;
    const double speed = turns ? 1 : 0.1, drag = typical_joint_friction(arm.joint[*joint]) / (speed * speed);
    return {{"drag", turns ? "N m s^2/rad^2" : "N s^2/m^2", 0, drag, 0, 30 * drag}};
  }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].joint_force -= c.p[0] * s[*c.joint].joint_rate * abs(s[*c.joint].joint_rate);
  }
};

/// Hum of the mains on a motor: τ = τ + A sin(2π f t). The rotor nearly moves alone, by A / (J (2π f)²); typically
/// three counts of its encoder.
class Hum : public EffectOf<Hum>, public AboveBand {
 public:
  std::string name() const override { return "hum"; }
  std::string summary() const override { return "a motor torque at the frequency of the mains"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::motor); }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_cable(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double torque = 3 * torque_of_a_count(arm.joint[*joint], kMains);
    return {{"amplitude", "N m", 0, torque, -100 * torque, 100 * torque}, {"frequency", "Hz", kMains, kMains, 45, 65}};
  }
  template <class T>
  void on_motor(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].motor_torque += c.p[0] * sin(T(T(2 * std::numbers::pi * c.time) * c.p[1]));
  }
  double encoder_counts(const ArmParameters<double>& arm, int joint, const double* p) const override {
    return std::abs(p[0]) / torque_of_a_count(arm.joint[joint], p[1]);
  }

 private:
  static constexpr double kMains = 50;
  static double torque_of_a_count(const JointParameters<double>& j, double frequency) {
    const double w = 2 * std::numbers::pi * frequency;
    return j.motor_encoder_resolution * j.rotor_inertia * w * w;
  }
};

}  // namespace

std::vector<const Effect*> outside_effects() {
  static const TorqueCrosstalk torque_crosstalk;
  static const SharedGuide shared_guide;
  static const PositionFriction position_friction;
  static const SwingingMass swinging_mass;
  static const WanderingSensor wandering_sensor;
  static const KinkedSensor kinked_sensor;
  static const QuadraticDrag quadratic_drag;
  static const Hum hum;
  return {&torque_crosstalk, &shared_guide,  &position_friction, &swinging_mass,
          &wandering_sensor, &kinked_sensor, &quadratic_drag,    &hum};
}

}  // namespace halyard::blind

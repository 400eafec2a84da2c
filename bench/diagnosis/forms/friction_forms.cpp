#include "bench/diagnosis/forms/unregistered.h"
#include "transmission/effects/typical_size.h"
#include "transmission/friction.h"

/// Friction of other forms than the library's.

namespace halyard::blind {
namespace {

/// More Coulomb friction at the motor, by four elastic contacts that slide one after another:
///   F = F_c/4 Σ z_i / z_y,i,   z_i' = v (1 - |z_i / z_y,i|⁴) where v z_i > 0,   z_i' = v elsewhere
/// Source: the generalized Maxwell-slip model, Al-Bender, Lampaert, Swevers, IEEE Trans. Automatic Control 50 (2005).
/// The fourth power rounds the point of sliding, so that the equations stay smooth.
class MaxwellSlipFriction : public EffectOf<MaxwellSlipFriction> {
 public:
  std::string name() const override { return "maxwell_slip_friction"; }
  std::string summary() const override {
    return "more friction at the motor, of contacts that slide one after another";
  }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::motor); }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_motor(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double level = typical_motor_friction(arm.joint[*joint]);
    return {{"coulomb", "N m", 0, 0.5 * level, 0, 30 * level}, {"presliding", "rad", 0.3, 0.3, 0.01, 3}};
  }
  int n_states() const override { return kContacts; }
  template <class T>
  void on_motor(const EffectContext<T>& c, JointSignals<T>* s) const {
    T held = 0.0;
    for (int i = 0; i < kContacts; ++i) held += c.z[i] / (T(kSlides[i]) * c.p[1]);
    s[*c.joint].motor_torque -= T(1.0 / kContacts) * c.p[0] * held;
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    const T v = s[*c.joint].motor_rate;
    for (int i = 0; i < kContacts; ++i) {
      const T u = c.z[i] / (T(kSlides[i]) * c.p[1]);
      z_dot[i] = v * (T(1.0) - select(v * u > T(0.0), T(u * u * u * u), T(0.0)));
    }
  }

 private:
  static constexpr int kContacts = 4;
  static constexpr double kSlides[kContacts] = {0.3, 0.7, 1.2, 1.8};  ///< deflections, relative to `presliding`
};

/// More friction at the joint, by LuGre's bristles with a constant level:
///   F = F_c z / z_y + σ_1 z' + F_v v,  z' = v - |v| z / z_y,  σ_1 = F_c 5 ms / z_y
/// Source: Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Automatic Control 40 (1995).
class LuGreJointFriction : public EffectOf<LuGreJointFriction> {
 public:
  std::string name() const override { return "lugre_joint_friction"; }
  std::string summary() const override { return "more friction at the joint, by bristles"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const bool turns = arm.joint[*joint].type == JointType::revolute;
    const double level = typical_joint_friction(arm.joint[*joint]), z_y = turns ? 2e-3 : 2e-4;
    return {{"coulomb", turns ? "N m" : "N", 0, 0.5 * level, 0, 30 * level},
            {"presliding", turns ? "rad" : "m", z_y, z_y, 0.1 * z_y, 10 * z_y},
            {"viscous", turns ? "N m s/rad" : "N s/m", 0, 0.1 * level, 0, 30 * level}};
  }
  int n_states() const override { return 1; }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    const T v = s[*c.joint].joint_rate;
    s[*c.joint].joint_force -= c.p[0] / c.p[1] * (c.z[0] + T(5e-3) * bristle_rate(c, v)) + c.p[2] * v;
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    z_dot[0] = bristle_rate(c, s[*c.joint].joint_rate);
  }

 private:
  template <class T>
  static T bristle_rate(const EffectContext<T>& c, const T& v) {
    return v - abs(v) * c.z[0] / c.p[1];
  }
};

/// Stribeck friction of the motor with an exponential of the speed instead of its square:
///   F = ΔF_s exp(-|v| / v_s) sign(v)
/// Source: Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994): exponents from 1/2 to 2 are in use.
class ExponentialStribeck : public EffectOf<ExponentialStribeck>, public RefinesSearch {
 public:
  std::string name() const override { return "exponential_stribeck"; }
  std::string summary() const override { return "friction that falls exponentially with speed"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::motor); }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_motor(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double level = typical_motor_friction(arm.joint[*joint]);
    return {{"static_excess", "N m", 0, 0.6 * level, 0, 10 * level}, {"speed", "rad/s", 15, 15, 1, 200}};
  }
  void refine_search(SearchSpace& space, const ArmParameters<double>&, EffectPlace) const override {
    space["speed"].per_motor_speed = 1;
  }
  template <class T>
  void on_motor(const EffectContext<T>& c, JointSignals<T>* s) const {
    const T v = s[*c.joint].motor_rate;
    s[*c.joint].motor_torque -=
        c.p[0] * exp(T(-abs(v) / c.p[1])) * smooth_sign(v, c.arm.joint[*c.joint].motor_smoothing);
  }
};

/// Friction of motor and joint that changes linearly in time instead of settling:
///   F = F (1 + a t / 32 s)       32 s: how long a trial's motion lasts, so that a > -1 leaves a friction
/// Source: the first-order term of warming up; Bittencourt and Gunnarsson, J. Dyn. Sys. Meas. Control 134 (2012), on
/// the friction of robot joints over temperature.
class LinearFrictionDrift : public EffectOf<LinearFrictionDrift> {
 public:
  std::string name() const override { return "linear_friction_drift"; }
  std::string summary() const override { return "friction that changes linearly in time"; }
  unsigned stages() const override {
    return static_cast<unsigned>(EffectStage::motor) | static_cast<unsigned>(EffectStage::joint);
  }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_motor(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"share", "1", 0, -0.5, -0.9, 3}};
  }
  template <class T>
  void on_motor(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[*c.joint];
    s[*c.joint].motor_torque -=
        share_now(c) * friction(j.motor_coulomb, j.motor_viscous, j.motor_smoothing, s[*c.joint].motor_rate);
  }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[*c.joint];
    s[*c.joint].joint_force -=
        share_now(c) * friction(j.joint_coulomb, j.joint_viscous, j.joint_smoothing, s[*c.joint].joint_rate);
  }

 private:
  template <class T>
  static T share_now(const EffectContext<T>& c) {
    constexpr double kSpan = 32;
    return c.p[0] * T(c.time / kSpan);
  }
};

}  // namespace

void add_friction_forms(OwnedEffects& to) {
  to.push_back({std::make_unique<MaxwellSlipFriction>(), "motor_friction", "motor_presliding"});
  to.push_back({std::make_unique<LuGreJointFriction>(), "joint_friction", "joint_presliding"});
  to.push_back({std::make_unique<ExponentialStribeck>(), "stribeck"});
  to.push_back({std::make_unique<LinearFrictionDrift>(), "friction_drift"});
}

}  // namespace halyard::blind

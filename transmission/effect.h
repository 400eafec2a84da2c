#pragma once
/// An effect: physical behaviour that the nominal model of an arm lacks. It is written once. The plant uses it as
/// truth, estimators use it in their process model, and the diagnosis tests it as an explanation.
///
/// An effect has named parameters, may have internal states z with their own derivative, and acts
/// at any of these places, in the order in which signals run from command to joint:
///
///   parameters    change()             once, before a run: parameters of chain, motors, cables, sensors
///   command       on_command()         s.motor_torque, from s.command and past commands
///   stretch       on_stretch()         s.stretch, and s.stretch_rate: its rate while the effect's states stand still
///   cable force   on_cable_force()     s.cable_force_motor, s.cable_force_joint
///   motor         on_motor()           s.motor_torque, after the motor's own friction
///   joint         on_joint()           s.joint_force, after the joint's own friction
///   sensors       on_sensors()         s.motor_error, s.joint_error: reading minus truth
///   states        state_rate()         z_dot; it may use s.motor_torque only if the effect acts at the command or
///                                      motor stage
///
/// To write an effect, derive from EffectOf<Yours> and define the members that you need as templates over the scalar T
/// (scalar.h), and stages(): no other member than those of its stages is called. effects/cable/backlash.cpp is an
/// example without states, effects/cable/hysteresis.cpp one with states.
/// An effect whose forces depend on one signal each can say so: then filters are faster (effects/one_signal.h).

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "transmission/arm_parameters.h"
#include "transmission/command_history.h"

namespace halyard {

inline constexpr int kMaxEffectParameters = 8;
inline constexpr int kMaxEffectStates = 8;  ///< of one effect

/// One parameter of an effect. The effect is absent when all its parameters are neutral.
struct EffectParameter {
  std::string name;  ///< as in model files and diagnosis.json
  std::string unit;
  /// value at which the parameter has no influence; for a shape parameter (below), the typical value
  double neutral = 0;
  /// Order of magnitude that the physics of such an arm suggests. A model file that lists the effect without any of its
  /// sizes gets all of them at this value; if it gives some, the others are neutral.
  double typical = 0;
  double lower = 0;  ///< physical bounds
  double upper = 0;

  /// True if the parameter gives the shape of the effect, not its size. In parameters(), a shape comes after the sizes
  /// that it belongs to: for example cosine and sine (sizes), then order (shape).
  bool is_shape() const { return neutral == typical; }
};

/// Where an effect may be placed.
enum class EffectScope {
  joint,   ///< at one joint
  arm,     ///< the whole arm
  either,  ///< at one joint, or at all joints alike (placed on the whole arm)
};

/// Where an effect is placed: the 0-based number of a joint, or kWholeArm. An effect that can only be at a joint
/// (EffectScope::joint) always gets a joint and need not check.
using EffectPlace = std::optional<int>;
inline constexpr std::nullopt_t kWholeArm = std::nullopt;

/// Signals of one joint at one instant. Torques and positions are positive in the joint's positive direction.
template <class T>
struct JointSignals {
  T command = 0.0;               ///< commanded motor torque, N m
  T motor_angle = 0.0;           ///< q_m, rad
  T motor_rate = 0.0;            ///< q_m', rad/s
  T joint_position = 0.0;        ///< q, rad | m
  T joint_rate = 0.0;            ///< q', rad/s | m/s
  T external_force = 0.0;        ///< measured external load on the joint, N m | N
  T motor_torque = 0.0;          ///< on the rotor, without the cable's pull, N m
  T stretch = 0.0;               ///< x, m
  T stretch_rate = 0.0;          ///< x', m/s
  T cable_force_motor = 0.0;     ///< g at the capstan, N
  T cable_force_joint = 0.0;     ///< g at the joint's pulley, N
  T joint_force = 0.0;           ///< Γ + friction + external, N m | N
  T motor_error = 0.0;           ///< motor encoder's reading minus truth, rad
  T joint_error = 0.0;           ///< joint encoder's reading minus truth, rad | m
  T joint_acceleration = 0.0;    ///< q'' for the sensors' errors; 0 where it is unknown, rad/s² | m/s²
  T motor_friction_drift = 0.0;  ///< relative change of the motor's friction in time, which friction_drift adds
  T joint_friction_drift = 0.0;  ///< of the joint's
};

/// Inputs that an effect may read.
template <class T>
struct EffectContext {
  const ArmParameters<T>& arm;    ///< after change() of all effects
  EffectPlace joint;              ///< 0-based; kWholeArm for an effect of the whole arm
  const T* p;                     ///< the effect's parameters
  const T* z;                     ///< the effect's states
  double time;                    ///< s
  const CommandHistory* history;  ///< past commands, or null
};

enum class EffectStage : unsigned { command = 1, stretch = 2, cable_force = 4, motor = 8, joint = 16, sensors = 32 };
inline constexpr int kEffectStages = 6;

class Effect;

/// The action and the rates of an effect over a type T that is wider than a register, as functions: those of a library
/// effect are compiled for several instruction sets (effects/built_in.h).
template <class T>
struct EffectCode {
  void (*act)(const Effect&, EffectStage, const EffectContext<T>&, JointSignals<T>* s);
  void (*rates)(const Effect&, const EffectContext<T>&, const JointSignals<T>* s, T* z_dot);
};
struct WideCode {
  EffectCode<Dual> dual;
  EffectCode<Lanes> lanes;
};

class Effect {
 public:
  virtual ~Effect() = default;

  virtual std::string name() const = 0;
  /// Short description of the effect, half a sentence.
  virtual std::string summary() const = 0;
  virtual EffectScope scope() const { return EffectScope::joint; }
  /// False if the joint cannot have the effect (no cable, no inboard joint, ...).
  virtual bool applies(const ArmParameters<double>&, int /*joint*/) const { return true; }
  virtual std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace joint) const = 0;
  /// Why these parameters, each within its bounds, cannot be combined, and the remedy; empty: they can.
  virtual std::string fault_of(const double* /*p*/) const { return ""; }
  virtual int n_states() const { return 0; }
  /// Typical size of each internal state.
  virtual std::vector<double> state_scale(const ArmParameters<double>&, EffectPlace /*joint*/,
                                          const double* /*p*/) const {
    return std::vector<double>(n_states(), 1.0);
  }
  /// Bitwise OR of the stages at which the effect acts.
  virtual unsigned stages() const { return 0; }
  /// Its place among the effects of this stage, where the physics gives one: the smaller rank acts first. Effects of
  /// the same rank act in the order in which the arm lists them.
  virtual int rank(EffectStage) const { return 0; }

  virtual void change_parameters(ArmParameters<double>&, EffectPlace joint, const double* p) const = 0;
  virtual void change_parameters(ArmParameters<Dual>&, EffectPlace joint, const Dual* p) const = 0;
  virtual void change_parameters(ArmParameters<Lanes>&, EffectPlace joint, const Lanes* p) const = 0;

  /// s: signals of all joints, [arm.n]; an effect at a joint reads and writes s[*joint].
  virtual void act(EffectStage, const EffectContext<double>&, JointSignals<double>* s) const = 0;
  HALYARD_INLINE void act(EffectStage g, const EffectContext<Dual>& c, JointSignals<Dual>* s) const {
    code_.dual.act(*this, g, c, s);
  }
  HALYARD_INLINE void act(EffectStage g, const EffectContext<Lanes>& c, JointSignals<Lanes>* s) const {
    code_.lanes.act(*this, g, c, s);
  }

  virtual void rates(const EffectContext<double>&, const JointSignals<double>* s, double* z_dot) const = 0;
  HALYARD_INLINE void rates(const EffectContext<Dual>& c, const JointSignals<Dual>* s, Dual* z_dot) const {
    code_.dual.rates(*this, c, s, z_dot);
  }
  HALYARD_INLINE void rates(const EffectContext<Lanes>& c, const JointSignals<Lanes>* s, Lanes* z_dot) const {
    code_.lanes.rates(*this, c, s, z_dot);
  }

  /// Replaces the code over Dual and Lanes by a copy for another instruction set.
  void use(const WideCode& copy) { code_ = copy; }

 protected:
  explicit Effect(const WideCode& code) : code_(code) {}

 private:
  WideCode code_;
};

/// Implements the interface above for a class with template members.
template <class Derived>
class EffectOf : public Effect {
 public:
  template <class T>
  void change(ArmParameters<T>&, EffectPlace, const T*) const {}
  template <class T>
  void on_command(const EffectContext<T>&, JointSignals<T>*) const {}
  template <class T>
  void on_stretch(const EffectContext<T>&, JointSignals<T>*) const {}
  template <class T>
  void on_cable_force(const EffectContext<T>&, JointSignals<T>*) const {}
  template <class T>
  void on_motor(const EffectContext<T>&, JointSignals<T>*) const {}
  template <class T>
  void on_joint(const EffectContext<T>&, JointSignals<T>*) const {}
  template <class T>
  void on_sensors(const EffectContext<T>&, JointSignals<T>*) const {}
  template <class T>
  void state_rate(const EffectContext<T>&, const JointSignals<T>*, T*) const {}

  void change_parameters(ArmParameters<double>& a, EffectPlace k, const double* p) const final {
    self().change(a, k, p);
  }
  void change_parameters(ArmParameters<Dual>& a, EffectPlace k, const Dual* p) const final { self().change(a, k, p); }
  void change_parameters(ArmParameters<Lanes>& a, EffectPlace k, const Lanes* p) const final { self().change(a, k, p); }
  using Effect::act, Effect::rates;
  void act(EffectStage g, const EffectContext<double>& c, JointSignals<double>* s) const final { act_at(g, c, s); }
  void rates(const EffectContext<double>& c, const JointSignals<double>* s, double* r) const final {
    self().state_rate(c, s, r);
  }

  /// Calls the member of this stage.
  template <class T>
  HALYARD_INLINE void act_at(EffectStage stage, const EffectContext<T>& c, JointSignals<T>* s) const {
    switch (stage) {
      case EffectStage::command: return self().on_command(c, s);
      case EffectStage::stretch: return self().on_stretch(c, s);
      case EffectStage::cable_force: return self().on_cable_force(c, s);
      case EffectStage::motor: return self().on_motor(c, s);
      case EffectStage::joint: return self().on_joint(c, s);
      case EffectStage::sensors: return self().on_sensors(c, s);
    }
  }

 protected:
  EffectOf() : Effect({{act_of<Dual>, rates_of<Dual>}, {act_of<Lanes>, rates_of<Lanes>}}) {}

 private:
  HALYARD_INLINE const Derived& self() const { return static_cast<const Derived&>(*this); }
  template <class T>
  static void act_of(const Effect& e, EffectStage stage, const EffectContext<T>& c, JointSignals<T>* s) {
    static_cast<const Derived&>(e).act_at(stage, c, s);
  }
  template <class T>
  static void rates_of(const Effect& e, const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) {
    static_cast<const Derived&>(e).state_rate(c, s, z_dot);
  }
};

/// An effect at a joint, with the values of its parameters, as a model file lists it or the diagnosis adds it.
template <class T>
struct EffectInstance {
  const Effect* effect = nullptr;
  EffectPlace joint = kWholeArm;  ///< 0-based
  T p[kMaxEffectParameters] = {};
};
using PlacedEffect = EffectInstance<double>;

/// "backlash of joint 2", "payload".
std::string effect_label(const PlacedEffect& effect);
/// True for the same effect at the same joint, whatever its parameters.
inline bool same_name(const PlacedEffect& a, const PlacedEffect& b) {
  return a.effect == b.effect && a.joint == b.joint;
}

/// All effects, in a fixed order.
const std::vector<const Effect*>& effect_library();
/// The effect of this name; null if there is none.
const Effect* find_effect(const std::string& name);
/// Adds a user's effect to the library. Throws std::invalid_argument if the name is taken or the effect has more than
/// kMaxEffectStates states.
void register_effect(std::unique_ptr<const Effect> effect);

/// The places where the arm can have the effect: kWholeArm first, then the joints.
std::vector<EffectPlace> effect_places(const Effect& effect, const ArmParameters<double>& arm);

/// The effect with its typical parameters. Throws std::invalid_argument if the joint cannot have the effect, or if it
/// has more than kMaxEffectParameters parameters.
PlacedEffect place_effect(const Effect& effect, const ArmParameters<double>& arm, EffectPlace joint);
/// The effect with neutral sizes and typical shapes; the caller then sets some of the sizes. Throws as
/// place_effect() does.
PlacedEffect place_neutral_effect(const Effect& effect, const ArmParameters<double>& arm, EffectPlace joint);

/// Moves each parameter that lies outside its bounds in this arm to the nearer bound. Bounds depend on the arm's
/// numbers: after these have changed, a value at a bound may lie outside, and no model file could contain it.
void keep_within_bounds(PlacedEffect& effect, const ArmParameters<double>& arm);

}  // namespace halyard

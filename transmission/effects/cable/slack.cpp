#include "transmission/cable_law.h"
#include "transmission/effects/built_in.h"
#include "transmission/effects/typical_size.h"

/// A run of the cable can pull but not push. With rest tension T, the tension of each run does not fall below zero:
///
///   g' = g + ρ (g_T - g),   g_T = max(0, T + g/2) - max(0, T - g/2)
///
///   g   force of the cable with its other effects                                  N
///   T   tension of each run at rest                                                N
///   ρ   share of compression that a slack run cannot carry: 1 cable, 0 rod         -
///
/// The paper's law does not clamp tension at zero; at ρ = 1 this effect does, with rest tension T. The linear and the
/// exponential law already clamp, with the model's T_0; for them g_T - g is the law with T in place of T_0 minus the
/// law, whatever the other effects are: beside a `hysteresis`, change T_0 instead. ρ is the size of the effect, T its
/// shape: at ρ = 0 the model's law is unchanged for every T.
///
/// Source: the clamp of cable_law.h.

namespace halyard::effects {

class Slack : public EffectOf<Slack> {
 public:
  std::string name() const override { return "slack"; }
  std::string summary() const override { return "a cable run that goes slack at low tension"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::cable_force); }
  /// A run carries the sum of what all others but the capstan's radius make of the force.
  int rank(EffectStage) const override { return 1; }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive == Drive::cable;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const JointParameters<double>& j = arm.joint[*joint];
    const double tension = j.stiffness * typical_stretch(j);  // the model's, or what moves the joint
    return {{"share", "1", 0, 1, 0, 1}, {"tension", "N", 0.5 * tension, 0.5 * tension, 1e-3 * tension, 10 * tension}};
  }

  template <class T>
  void on_cable_force(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[*c.joint];
    JointSignals<T>& own = s[*c.joint];
    if (j.law == CableLaw::paper) {
      own.cable_force_motor += c.p[0] * clamped_by(own.cable_force_motor, c.p[1]);
      own.cable_force_joint += c.p[0] * clamped_by(own.cable_force_joint, c.p[1]);
      return;
    }
    const RunTensions<T> run = run_tensions(j, c.p[1], own.stretch, own.stretch_rate);
    const T change = c.p[0] * (run.forward - run.backward - cable_force(j, own.stretch, own.stretch_rate));
    own.cable_force_motor += change;
    own.cable_force_joint += change;
  }

 private:
  /// g_T - g.
  template <class T>
  static T clamped_by(const T& g, const T& tension) {
    const T half = T(0.5) * g;
    return max(T(0.0), T(tension + half)) - max(T(0.0), T(tension - half)) - g;
  }
};

HALYARD_EFFECT(Slack)

}  // namespace halyard::effects

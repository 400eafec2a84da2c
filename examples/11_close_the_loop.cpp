/// 11. Close the loop: from a record that the model does not explain to the effect that it lacks.
///
///   simulate with a backlash that is not declared -> diagnose with the nominal model -> compare on another record
///
/// One joint of the arm alone, 12 s of it, so that it takes seconds; the diagnosis works on any arm.
///
/// Look for: the name, the joint, and the size of the gap against the true one; and the error of the joint's position,
/// predicted from motor signals, on a record that the diagnosis has not seen.

#include "arm_example.h"
#include "diagnosis/diagnose.h"

namespace {

using namespace halyard;

/// The arm's elbow on its own: one joint with gravity on it.
ArmModel elbow() {
  ArmModel arm = raven2();
  arm.nominal.joint[0] = arm.nominal.joint[1];
  arm.nominal.joint[0].coupling[0] = 1;
  arm.nominal.joint[0].coupling[1] = 0;
  arm.nominal.n = 1;
  arm.joints = {arm.joints[1]};
  return arm;
}

/// A record of two sines.
Log record(const ArmModel& arm, double duration_s, double frequency_hz) {
  Scenario scenario = on_sines(arm, duration_s);
  scenario.trajectory[0].sines = {{0.25, frequency_hz, 0}, {0.12, 2.7 * frequency_hz, 1}};
  return simulate(scenario).measured;
}

}  // namespace

int main() {
  const ArmModel nominal = elbow();
  ArmModel real = nominal;
  real.effects.push_back(place_effect(*find_effect("backlash"), real.nominal, 0));
  real.effects[0].p[0] = 0.35e-3;

  const Diagnosis d = diagnose(nominal, {record(real, 12, 0.4)}, record(real, 4, 0.55), {});

  for (const NamedEffect& e : d.effects) {
    fmt::print("found: {}\n", effect_label(e.effect));
    for (const Estimated& p : e.parameters)
      fmt::print("  {} {:.4g} {}, 95 % interval {:.4g} to {:.4g}\n", p.name, p.value, p.unit, p.lower, p.upper);
    for (const Alternative& a : e.alternatives)
      fmt::print("  these data cannot tell it from {}\n", effect_label(a.effect));
  }
  const bool alone = d.effects.size() == 1 && d.effects[0].effect.effect == real.effects[0].effect;
  fmt::print("true: backlash, half_gap {:.4g} m; found and nothing else: {}\n", real.effects[0].p[0],
             alone ? "yes" : "no");
  fmt::print("joint position on the other record, RMS error: nominal model {}, revised model {}\n",
             in_units(nominal, 0, d.before.joint_rms[0]), in_units(nominal, 0, d.after.joint_rms[0]));
}

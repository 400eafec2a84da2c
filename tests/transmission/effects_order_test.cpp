/// Effects that act on the same signals: their order, and what one leaves to the next; signals that are used again.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/effect_runs.h"
#include "tests/support/random_arm.h"
#include "transmission/effects/library.h"
#include "transmission/transmission.h"

namespace halyard {
namespace {

TEST(Transmission, TheCablesStretchChangesWithItsMotionLessWhatACreepTakesUp) {
  const ArmParameters<double> arm = random_arm(15, CableLaw::linear);
  constexpr double kShare = 0.5, kLag = 2;
  PlacedEffect creep = place_effect(*find_effect("creep"), arm, 0);
  creep.p[0] = kShare, creep.p[1] = kLag;
  const Transmission<double> transmission(arm, {creep});
  JointSignals<double> s[kMaxJoints];
  for (int k = 0; k < 3; ++k) {
    s[k].motor_angle = 0.3 + 0.1 * k, s[k].motor_rate = 0.7;
    s[k].joint_position = -0.2, s[k].joint_rate = 0.4;
  }
  const double z = 0.02;
  double z_dot = 0, rate[kMaxJoints] = {};
  transmission.evaluate(0, nullptr, &z, s, &z_dot);
  transmission.total_stretch_rates(0, nullptr, &z, &z_dot, s, rate);
  // x_e = x - c z and z' = (x_e - z) / τ; stretch_rate is the rate while z stands still.
  EXPECT_NEAR(z_dot, (s[0].stretch - z) / kLag, 1e-15);
  ASSERT_GT(std::abs(kShare * z_dot), 1e-3) << "the test shows nothing";
  // A difference over 2e-4 s of stretches below 1 m rounds by 1e-12 m/s.
  EXPECT_NEAR(rate[0], s[0].stretch_rate - kShare * z_dot, 1e-9);
  for (const int k : {1, 2}) EXPECT_NEAR(rate[k], s[k].stretch_rate, 1e-9) << k;
}

TEST(Transmission, SignalsOfAnEarlierEvaluationDoNotCount) {
  ArmParameters<double> arm = random_arm(15, CableLaw::linear);
  arm.joint[1].drive = Drive::rigid;
  PlacedEffect drift = place_neutral_effect(*find_effect("friction_drift"), arm, 0);
  drift.p[1] = 0.5;  // start
  const Transmission<double> transmission(arm, {drift, place_effect(*find_effect("motor_presliding"), arm, 0),
                                                place_effect(*find_effect("joint_presliding"), arm, 0)});
  JointSignals<double> s[kMaxJoints];
  for (int k = 0; k < 3; ++k) s[k].command = 0.5, s[k].motor_rate = 0.7, s[k].joint_rate = 0.4;
  const double z[] = {0.01, 0.001};
  double z_dot[2];
  const auto evaluated = [&] {
    transmission.evaluate(0, nullptr, z, s, z_dot);
    return std::vector<double>{s[0].motor_torque, s[0].joint_force, s[1].stretch, s[1].stretch_rate};
  };
  const std::vector<double> once = evaluated();
  s[1].stretch = s[1].stretch_rate = 7;  // as memory that nothing has set
  EXPECT_EQ(evaluated(), once);
}

/// A user's effect at the command stage.
class HalvesTorque : public EffectOf<HalvesTorque> {
 public:
  std::string name() const override { return "halves_torque"; }
  std::string summary() const override { return "for tests"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::command); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"share", "1", 0, 1, 0, 1}};
  }
  template <class T>
  void on_command(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].motor_torque = T(0.5) * s[*c.joint].motor_torque;
  }
};

TEST(Transmission, ADelayActsBeforeAndAnAmplifierLimitsBehindWhatAUserMakesOfTheCommand) {
  ArmParameters<double> arm = random_arm(15, CableLaw::linear);
  JointParameters<double>& j = arm.joint[0];
  j.torque_scale = 1, j.torque_bias = j.motor_coulomb = j.motor_viscous = 0;
  CommandHistory history(3, 1);
  for (int i = 0; i <= 100; ++i) {
    const double command[3] = {i < 95 ? 0.1 : 3.0, 0, 0};
    history.push(i * 1e-3, command);
  }
  const HalvesTorque halves;
  const PlacedEffect half = place_effect(halves, arm, 0);
  PlacedEffect delay = place_neutral_effect(*find_effect("delay"), arm, 0),
               limit = place_neutral_effect(*find_effect("actuator_saturation"), arm, 0);
  delay.p[0] = 0.05;
  limit.p[0] = 1, limit.p[1] = 0.4, limit.p[2] = 1e4;
  const auto torque = [&](const PlacedEffect& first, const PlacedEffect& second) {
    const Transmission<double> transmission(arm, {first, second});
    JointSignals<double> s[kMaxJoints];
    s[0].command = 3;
    transmission.evaluate(0.1, &history, nullptr, s, nullptr);
    return s[0].motor_torque;
  };
  // Half of the command of 50 ms ago; a half of 3 N m is limited to 0.4.
  EXPECT_NEAR(torque(delay, half), 0.05, 1e-12);
  EXPECT_NEAR(torque(half, delay), 0.05, 1e-12);
  EXPECT_NEAR(torque(limit, half), 0.4, 1e-12);
  EXPECT_NEAR(torque(half, limit), 0.4, 1e-12);
}

TEST(Hysteresis, UnderThePapersLawReplacesItsShareByASpringOfTwiceTheStiffnessOfARun) {
  ArmParameters<double> arm = random_arm(7, CableLaw::paper);
  arm.joint[0].damping = 0;
  const double share = 0.4, x = 0.1;
  const Transmission<double> bare(arm, {}), with(arm, {placed("hysteresis", arm, 0, {share, 0.02})});
  const Motion m = stretched(arm, 0, x, 0);
  for (const double z : {0.0, 0.01}) {
    const Evaluated e = evaluate(with, m, &z), plain = evaluate(bare, m);
    const double expected = share * 2 * arm.joint[0].stiffness * (z - x);
    EXPECT_NEAR(e.s[0].cable_force_joint - plain.s[0].cable_force_joint, expected, 100 * 8 * kEps) << z;
    EXPECT_NEAR(e.s[0].cable_force_motor - plain.s[0].cable_force_motor, expected, 100 * 8 * kEps) << z;
  }
}

TEST(PulleyFriction, GrowsWithWhatASlackRunLeavesOfTheForce) {
  ArmParameters<double> arm = random_arm(7, CableLaw::paper);
  JointParameters<double>& j = arm.joint[0];
  j.damping = 0;
  const double x = 0.1, tension = 4, coefficient = 0.05, motor_share = 0.3;
  Motion m = stretched(arm, 0, x, 0);
  m.motor_rate[0] = 40 * j.motor_smoothing, m.joint_rate[0] = 40 * j.joint_smoothing;  // tanh(40) is 1
  // g = 2 k sinh x; half of it exceeds the tension, so that one run is slack and T + g/2 is left.
  const double half = j.stiffness * std::sinh(x), left = tension + half;
  ASSERT_GT(half, tension);
  const double level = coefficient * (2 * j.tension + left);
  const PlacedEffect slack = placed("slack", arm, 0, {1, tension}),
                     rubs = placed("pulley_friction", arm, 0, {coefficient, motor_share});
  for (const auto& effects : {std::vector{slack, rubs}, std::vector{rubs, slack}}) {
    const Evaluated e = evaluate(Transmission<double>(arm, effects), m);
    EXPECT_NEAR(e.s[0].cable_force_motor, left + motor_share * level, 1e-12);
    EXPECT_NEAR(e.s[0].cable_force_joint, left - (1 - motor_share) * level, 1e-12);
  }
}

}  // namespace
}  // namespace halyard

#include "diagnosis/round/essence.h"

#include <gtest/gtest.h>

#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"
#include "transmission/effects/typical_size.h"

namespace halyard {
namespace {

PlacedEffect effect_of_joint_1(const char* name, double first, double second) {
  PlacedEffect e = place_neutral_effect(*find_effect(name), first_joints(1).nominal, 0);
  e.p[0] = first, e.p[1] = second;
  return e;
}

/// Whether an effect that is fitted to the log of an arm with `truth` is another one. start: of its fit.
bool is_another(const PlacedEffect& truth, const PlacedEffect& start) {
  const ArmModel model = first_joints(1);
  ArmModel robot = model;
  robot.effects = {truth};
  const Evidence evidence(make_records(simulate(motion(robot, 6)).measured, model, {}), model);
  const Refitter refitter(evidence, model, 0);
  const Judge judge(evidence, model, refitter.numbers());
  const Hypothesis from{model.nominal, {start}};
  const Hypothesis fitted = refitter.refit(from, evidence.score(from)).hypothesis;
  return is_another_effect(evidence, refitter, judge, {fitted, evidence.score(fitted)}, 0);
}

/// Friction of motor and joint that rises to this factor at once, and then by this rate, 1/s.
PlacedEffect drifting_friction(double rate, double factor) { return effect_of_joint_1("friction_drift", rate, factor); }

TEST(Essence, OfADriftIsThatItDrifts) {
  EXPECT_TRUE(is_another(drifting_friction(0, 1.6), drifting_friction(0.01, 1.5)));
  EXPECT_FALSE(is_another(drifting_friction(0.08, 1.2), drifting_friction(0.01, 1.5)));
}

TEST(Essence, OfAHysteresisIsItsLoop) {
  const double stretch = typical_stretch(first_joints(1).nominal.joint[0]);
  const PlacedEffect start = effect_of_joint_1("hysteresis", 0.4, 0.01 * stretch);
  EXPECT_TRUE(is_another(effect_of_joint_1("stiffness", 0.5, 1), start));
  // It yields early, but a softer cable takes no energy from the motion.
  const PlacedEffect early = effect_of_joint_1("hysteresis", 0.8, 0.02 * stretch);
  EXPECT_FALSE(is_another(early, early));
}

TEST(Essence, OfAHysteresisBesideASofterCableHasConvincedAlready) {
  const ArmModel model = first_joints(1);
  const Refitter refitter(made_evidence(), model, 0);
  const Judge judge(made_evidence(), model, {});
  const double stretch = typical_stretch(model.nominal.joint[0]);
  const Hypothesis both{model.nominal,
                        {effect_of_joint_1("stiffness", 0.5, 1), effect_of_joint_1("hysteresis", 0.4, 0.1 * stretch)}};
  EXPECT_FALSE(is_another_effect(made_evidence(), refitter, judge, {both, made_evidence().score(both)}, 1));
}

TEST(Essence, OfAHysteresisBesideASofterCableOfTheModelIsItsLoop) {
  ArmModel model = first_joints(1);
  model.effects = {effect_of_joint_1("stiffness", 0.5, 1)};
  ArmModel robot = model;
  robot.effects[0].p[0] = 0.3;
  const Evidence evidence(make_records(simulate(motion(robot, 6)).measured, model, {}), model);
  const Refitter refitter(evidence, model, model.effects.size());
  const Judge judge(evidence, model, refitter.numbers());
  const double stretch = typical_stretch(model.nominal.joint[0]);
  Hypothesis h{model.nominal, model.effects};
  h.effects.push_back(effect_of_joint_1("hysteresis", 0.4, 0.003 * stretch));
  h = refitter.refit(h, evidence.score(h)).hypothesis;
  EXPECT_TRUE(is_another_effect(evidence, refitter, judge, {h, evidence.score(h)}, 1)) << "the cable is softer still";
}

TEST(Essence, AHysteresisThatIsASofterCableYieldsAsEarlyAsItCan) {
  const ArmParameters<double> arm = first_joints(1).nominal;
  const PlacedEffect loop = place_effect(*find_effect("hysteresis"), arm, 0);
  const auto softer = at_the_end_that_is(effect_of_joint_1("stiffness", 0.3, 1), loop, arm);
  ASSERT_TRUE(softer);
  EXPECT_NEAR(softer->p[0], 0.7, 1e-12);
  EXPECT_EQ(softer->p[1], loop.effect->parameters(arm, 0)[1].lower);
  EXPECT_FALSE(at_the_end_that_is(effect_of_joint_1("stiffness", 2, 1), loop, arm)) << "no loop is stiffer";
}

TEST(Essence, OfAHysteresisIsNotThatOfAnotherEffectThanASofterCable) {
  const ArmParameters<double> arm = first_joints(2).nominal;
  const auto at = [&](const char* name, int joint) { return place_neutral_effect(*find_effect(name), arm, joint); };
  EXPECT_TRUE(becomes(at("hysteresis", 0), at("stiffness", 0), arm));
  EXPECT_FALSE(becomes(at("hysteresis", 0), at("stiffness", 1), arm));
  EXPECT_FALSE(becomes(at("hysteresis", 0), at("slack", 0), arm));
  EXPECT_FALSE(becomes(at("friction_drift", 0), at("motor_friction", 0), arm)) << "both names are true";
}

}  // namespace
}  // namespace halyard

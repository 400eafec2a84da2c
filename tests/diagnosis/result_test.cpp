/// What a diagnosis tells of an arm of one joint whose motor has twice the friction of its model.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/diagnose.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

struct Told {
  ArmModel model = first_joints(1);
  double coulomb = model.nominal.joint[0].motor_coulomb;
  std::set<std::string> stages;
  bool all_are_fractions = true;
  Diagnosis diagnosis;

  Told() {
    ArmModel robot = model;
    robot.nominal.joint[0].motor_coulomb *= 2;
    DiagnosisOptions options;
    options.most_effects = 1;
    Log training = simulate(motion(robot, 8)).measured, holdout = simulate(motion(robot, 4, 1)).measured;
    training.source = "training.csv", holdout.source = "other.csv";
    diagnosis = diagnose(model, {training}, holdout, options, [&](const std::string& stage, double fraction) {
      stages.insert(stage);
      all_are_fractions = all_are_fractions && fraction >= 0 && fraction <= 1;
    });
  }
};

const Told& told() {
  static const Told once;
  return once;
}

TEST(ResultOfADiagnosis, NamesTheEffectWithItsSizeAndHowSureItIs) {
  const Diagnosis& d = told().diagnosis;
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::effects);
  ASSERT_EQ(d.effects.size(), 1u);
  const NamedEffect& named = d.effects[0];
  EXPECT_EQ(named.effect.effect->name(), "motor_friction");
  EXPECT_EQ(named.effect.joint, 0);
  EXPECT_GT(named.probability, 0.5);
  EXPECT_LE(named.probability, 1);
  EXPECT_TRUE(named.log.empty()) << "there is one log, and the effect has no instants";
  const auto size = std::ranges::find(named.parameters, "coulomb_change", &Estimated::name);
  ASSERT_NE(size, named.parameters.end());
  EXPECT_LT(size->lower, size->value);
  EXPECT_GT(size->upper, size->value);
  EXPECT_NEAR(size->value, told().coulomb, 0.2 * told().coulomb) << "what is beyond the model's friction";
  EXPECT_EQ(named.effect.p[0], size->value);
  EXPECT_EQ(named.index, 0u);
  double sum = named.probability, last = 1;
  for (const Alternative& a : named.alternatives) {
    EXPECT_LE(a.probability, last) << "the most probable first";
    last = a.probability;
    if (!same_name(a.effect, named.effect)) sum += a.probability;
  }
  EXPECT_LE(sum, 1 + 1e-9);
  EXPECT_LT(d.probability_clean, 0.05);
  EXPECT_LT(d.probability_none, 0.5);
  EXPECT_TRUE(d.unexplained.empty());
  EXPECT_EQ(d.tolerance_factor, 1);
}

TEST(ResultOfADiagnosis, RevisesTheModelByWhatItTells) {
  const Diagnosis& d = told().diagnosis;
  EXPECT_TRUE(d.given.effects.empty());
  EXPECT_EQ(d.given.nominal.joint[0].motor_coulomb, told().coulomb);
  ASSERT_EQ(d.revised.effects.size(), 1u);
  EXPECT_EQ(d.revised.effects[0].p[0], d.effects[0].effect.p[0]);
  EXPECT_TRUE(d.absent_events.empty());
  EXPECT_EQ(d.revised_on_holdout().effects.size(), 1u);
}

TEST(ResultOfADiagnosis, TellsWhichEffectOfTheRevisedModelHasTheName) {
  ArmModel model = first_joints(1);
  model.effects.push_back(place_neutral_effect(*find_effect("capstan_ratio"), model.nominal, 0));
  model.effects[0].p[0] = 1.02;
  ArmModel robot = model;
  robot.nominal.joint[0].motor_coulomb *= 2;
  DiagnosisOptions options;
  options.most_effects = 1;
  options.tell_not_excited = false;
  const Diagnosis d = diagnose(model, {simulate(motion(robot, 5)).measured}, {}, options);
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects[0].index, 1u) << "the model came with one";
  ASSERT_EQ(d.revised.effects.size(), 2u);
  EXPECT_TRUE(same_name(d.revised.effects[d.effects[0].index], d.effects[0].effect));
}

TEST(ResultOfADiagnosis, TellsThatANumberHasUsedUpItsTolerance) {
  const ArmModel model = first_joints(1);
  const auto refitted = [&](double tolerances) {
    ArmModel robot = model;
    robot.nominal.joint[0].motor_coulomb *= 1 + tolerances * model.joints[0].tolerances.friction;
    DiagnosisOptions options;
    options.tell_not_excited = false;
    const Diagnosis d = diagnose(model, {simulate(motion(robot, 8)).measured}, {}, options);
    EXPECT_TRUE(d.effects.empty()) << "it is within the tolerance, or so little beyond it that it does not matter";
    const auto number = std::ranges::find(d.refitted, "joint 1 motor Coulomb friction", &Estimated::name);
    return number == d.refitted.end() ? std::nullopt : std::optional(*number);
  };
  const auto all = refitted(1.05), half = refitted(0.5);
  ASSERT_TRUE(all && half);
  EXPECT_TRUE(all->at_bound) << all->value / told().coulomb;
  EXPECT_FALSE(half->at_bound) << half->value / told().coulomb;
  EXPECT_NEAR(all->most, 1.2 * told().coulomb, 1e-9 * told().coulomb);
}

TEST(ResultOfADiagnosis, HasARevisedModelAlsoIfNoEffectHasAName) {
  Diagnosis d;
  d.given = d.revised = first_joints(1);
  EXPECT_FALSE(d.is_revised());
  d.refitted.resize(1);
  EXPECT_TRUE(d.is_revised());
  d.refitted.clear();
  d.revised.effects.push_back(place_effect(*find_effect("motor_friction"), d.given.nominal, 0));
  EXPECT_TRUE(d.is_revised());
  d.given = d.revised;
  EXPECT_FALSE(d.is_revised()) << "the model came with it";
}

TEST(ResultOfADiagnosis, ErrorsOnTheHoldOutAreSmallerAndSplitIntoBiasAndSpread) {
  const Diagnosis& d = told().diagnosis;
  EXPECT_LT(d.after.torque_rms.at(0), 0.3 * d.before.torque_rms.at(0));
  for (const PredictionError* e : {&d.before, &d.after}) {
    for (const auto& [rms, parts] :
         {std::pair(e->torque_rms.at(0), &e->torque), std::pair(e->joint_rms.at(0), &e->joint)})
      EXPECT_NEAR(std::hypot(parts->bias.at(0), parts->spread.at(0)), rms, 1e-9 * rms);
    EXPECT_GE(e->joint_peak.at(0), e->joint_rms.at(0));
    EXPECT_GT(e->joint_rms.at(0), 0);
  }
}

TEST(ResultOfADiagnosis, TheIntervalOfThePredictionContainsMostOfTheHoldOut) {
  const PredictionInterval& interval = told().diagnosis.joint_interval;
  ASSERT_EQ(interval.half_width.size(), 1u);
  EXPECT_GT(interval.half_width[0], 0);
  EXPECT_LT(interval.half_width[0], 1e-3);  // rad: the encoder resolves 8e-5
  EXPECT_GT(interval.coverage.at(0), 0.9);
  EXPECT_LE(interval.coverage.at(0), 1);
}

TEST(ResultOfADiagnosis, TellsWhatTheMotionCannotShowOfThisArm) {
  for (const NotExcited& n : told().diagnosis.not_excited) {
    EXPECT_NE(n.effect, "motor_friction");
    EXPECT_FALSE(n.why.empty());
    EXPECT_TRUE(n.joint == EffectPlace(0) || n.joint == kWholeArm);
  }
  EXPECT_TRUE(told().all_are_fractions);
  EXPECT_TRUE(told().stages.contains("hold-out"));
  EXPECT_EQ(told().diagnosis.holdout, "other.csv");
}

}  // namespace
}  // namespace halyard

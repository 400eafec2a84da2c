/// What the effects that were found may miss, because the form of their equations may be another one.

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/judgement/judge.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

/// Its sizes are so many times the typical ones.
PlacedEffect sized(const std::string& name, const ArmModel& model, int joint, double of_typical) {
  PlacedEffect e = place_effect(*find_effect(name), model.nominal, joint);
  const auto parameters = e.effect->parameters(model.nominal, joint);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    e.p[i] = parameters[i].neutral + of_typical * (e.p[i] - parameters[i].neutral);
  return e;
}

TEST(Misfit, OnlyWhatYieldsInTheSameCableMendsAForm) {
  const ArmModel model = first_joints(2);
  const auto mends = [&](const std::string& candidate, int joint) {
    return mends_the_form_of(sized(candidate, model, joint, 1), sized("backlash", model, 1, 1), model.nominal);
  };
  EXPECT_TRUE(mends("stiffness", 1));
  EXPECT_TRUE(mends("creep", 1));
  EXPECT_FALSE(mends("stiffness", 0)) << "another cable";
  EXPECT_FALSE(mends("joint_friction", 1)) << "not in the cable";
  EXPECT_FALSE(mends("cable_slip", 1)) << "happens at an instant";
}

/// Joint 2 has a constant zero error and a ratio that is off.
struct Offsets {
  ArmModel model = first_joints(2);
  ArmModel robot = model;
  Evidence evidence;

  Offsets() : evidence(records(), model) {}
  std::vector<Record> records() {
    robot.effects = {sized("encoder_offset", model, 1, 1), sized("encoder_eccentricity", model, 1, 10)};
    return make_records(simulate(motion(robot, 6)).measured, model, {});
  }
  Scored truth() const {
    const Hypothesis h{model.nominal, robot.effects};
    return {h, evidence.score(h)};
  }
};

TEST(Misfit, IsAShareOfWhatAnEffectDoesBesideAConstant) {
  const Offsets arm;
  const Scored truth = arm.truth();
  const std::vector<double> of_offset = mean_square_misfit(arm.evidence, truth, {0}),
                            of_eccentricity = mean_square_misfit(arm.evidence, truth, {1}),
                            of_both = mean_square_misfit(arm.evidence, truth, {0, 1});
  const Score without = arm.evidence.score(without_effect(truth.hypothesis, 1));
  double square = 0, sum = 0, n = 0;
  for (std::size_t r = 0; r < without.deciding.size(); ++r) {
    const double change = without.deciding[r] - truth.score.deciding[r];
    if (change != 0) square += change * change, sum += change, n += 1;  // only the sensor of joint 2 changes
  }
  const double variance = square / n - std::pow(sum / n, 2);
  EXPECT_NEAR(of_eccentricity[3], std::pow(kRule.form_misfit, 2) * variance, 1e-6 * variance);
  EXPECT_LT(of_offset[3], 1e-4 * of_eccentricity[3]) << "its own size absorbs what is missed of a constant";
  EXPECT_NEAR(of_both[3], of_eccentricity[3], 1e-4 * of_eccentricity[3]);
  EXPECT_LT(of_both[2], 1e-4 * of_both[3]) << "joint 1 has neither";
}

TEST(Misfit, ARestWithinItIsNotSignificant) {
  const Offsets arm;
  Hypothesis nearly{arm.model.nominal, arm.robot.effects};
  const auto rest_beside = [&](double share) -> bool {
    nearly.effects[1].p[0] = share * arm.robot.effects[1].p[0];
    const Scored found{nearly, arm.evidence.score(nearly)};
    EXPECT_TRUE(significant_rest(arm.evidence, found.score)[3]);
    return significant_rest(arm.evidence, found.score, mean_square_misfit(arm.evidence, found, {1}))[3];
  };
  EXPECT_FALSE(rest_beside(0.9));
  EXPECT_TRUE(rest_beside(0.7));
}

/// Joint 2 is pushed for a second, as its model says, so that a creep of its cable does most then. Beside the creep, a
/// small effect is missing.
bool matters_beside_a_creep(const std::string& name, double of_typical) {
  ArmModel model = first_joints(2);
  PlacedEffect push = place_neutral_effect(*find_effect("external_force"), model.nominal, 1);
  push.p[0] = 20, push.p[1] = 5, push.p[2] = 6;  // N m, s
  model.effects = {push};
  const PlacedEffect creep = sized("creep", model, 1, 3), small = sized(name, model, 1, of_typical);
  ArmModel robot = model;
  robot.effects = {push, creep, small};
  const Evidence evidence(make_records(simulate(motion(robot, 12)).measured, model, {}), model);
  const Hypothesis with{model.nominal, robot.effects}, found = without_effect(with, 2);
  const Scored without{found, evidence.score(found)};
  EXPECT_LT(without.score.mean_square[3] - evidence.score(with).mean_square[3],
            mean_square_misfit(evidence, without, {1})[3])
      << "it would be too small if the creep acted alike at all times";
  return Judge(evidence, model, {}).trial(with, without, 2).matters;
}

TEST(Misfit, AnEffectInTheSameCableHasToExceedItAtAllTimes) {
  EXPECT_TRUE(matters_beside_a_creep("encoder_eccentricity", 0.1));
  EXPECT_FALSE(matters_beside_a_creep("stiffness", 0.015));
}

}  // namespace
}  // namespace halyard

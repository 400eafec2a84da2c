#include "diagnosis/judgement/judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

/// The elbow is pushed for two seconds, if at all, and pressed against something soft all the time.
struct Tug {
  ArmModel model = first_joints(2);
  PlacedEffect push = place_neutral_effect(*find_effect("external_force"), model.nominal, 1);
  Evidence evidence;
  Judge judge;

  Tug(double force, double stiffness)
      : evidence(make_records(record(force, stiffness), model, {}), model), judge(evidence, model, {}) {
    // The something is where the motion ends: the end of what a search may ask for.
    push.p[5] = evidence.joint_span(1).first;
  }
  Log record(double force, double stiffness) {
    push.p[0] = force, push.p[1] = 2, push.p[2] = 4;                // N m, s
    push.p[4] = stiffness, push.p[5] = model.joints[1].home - 0.4;  // N m/rad, rad
    ArmModel robot = model;
    robot.effects = {push};
    return simulate(motion(robot, 6)).measured;
  }
  /// The verdict on a push and a contact of these sizes.
  Trial trial(double force, double stiffness) const {
    Hypothesis with{model.nominal, {push}}, without{model.nominal, {}};
    with.effects[0].p[0] = force, with.effects[0].p[4] = stiffness;
    return judge.trial(with, {without, evidence.score(without)}, 0);
  }
};

TEST(Judge, AContactAtTheEndOfTheMotionDoesNotDiscardThePushBesideIt) {
  const Tug tug(1, 0.03), none(0, 0.2);
  const Trial both = tug.trial(1, 0.03), push = tug.trial(1, 0), contact = none.trial(0, 0.2);
  ASSERT_TRUE(both.is_judged() && push.is_judged() && contact.is_judged());
  EXPECT_GT(both.gain, push.gain + kRule.by_chance) << "the contact mends the form of the push";
  EXPECT_FALSE(both.at_bound);
  EXPECT_FALSE(push.at_bound);
  EXPECT_TRUE(contact.at_bound);
}

TEST(Judge, AWallThatIsTouchedInTheWholeMotionIsAtItsBound) {
  const ArmModel model = first_joints(2);
  const Span span = Tug(0, 0).evidence.joint_span(1);
  PlacedEffect wall = place_neutral_effect(*find_effect("external_force"), model.nominal, 1);
  wall.p[4] = 5;  // N m/rad, above the position
  for (const double share : {0.03, 0.5}) {
    wall.p[5] = span.first + share * (span.last - span.first);
    ArmModel robot = model;
    robot.effects = {wall};
    const Evidence evidence(make_records(simulate(motion(robot, 6)).measured, model, {}), model);
    const Hypothesis without{model.nominal, {}};
    const Trial trial =
        Judge(evidence, model, {}).trial({model.nominal, {wall}}, {without, evidence.score(without)}, 0);
    EXPECT_EQ(trial.at_bound, share < 0.05) << share;
  }
}

TEST(Judge, OfTwoCausesTheTruthFitsBetterAndTheOtherDoesNot) {
  const Tug tug(1, 0.03);
  PlacedEffect friction = place_neutral_effect(*find_effect("motor_friction"), tug.model.nominal, 1);
  friction.p[0] = 0.5 * tug.model.nominal.joint[1].motor_coulomb;
  const auto scored = [&](const PlacedEffect& effect) {
    const Hypothesis h{tug.model.nominal, {effect}};
    return Scored{h, tug.evidence.score(h)};
  };
  const Scored truth = scored(tug.push), other = scored(friction);
  EXPECT_GT(tug.judge.gain_over(truth, other), 10);
  EXPECT_EQ(tug.judge.gain_over(other, truth), -tug.judge.gain_over(truth, other));
}

/// Motor 1 has more Coulomb friction than its model, and its torque is noisy.
struct NoisyFriction {
  ArmModel model = first_joints(2);
  double change = 0.6 * model.nominal.joint[0].motor_coulomb;
  Evidence evidence{make_records(record(), model, {}), model};
  Hypothesis with{model.nominal, {place_neutral_effect(*find_effect("motor_friction"), model.nominal, 0)}};

  NoisyFriction() { with.effects[0].p[0] = change; }
  Log record() const {
    ArmModel robot = model;
    robot.nominal.joint[0].motor_coulomb += change;
    Log log = simulate(motion(robot, 6)).measured;
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 6e-3);  // N m; 1e-3 in the compared band
    for (double& torque : log.motor_torque[0]) torque += noise(random);
    return log;
  }
  /// The friction as an effect, if a number of the model hides this share of it. numbers: those that may be refitted.
  Trial beside(double hidden, std::vector<FitParameter> numbers) const {
    Hypothesis without{model.nominal, {}};
    without.nominal.joint[0].motor_coulomb += hidden * change;
    return Judge(evidence, model, std::move(numbers)).trial(with, {without, evidence.score(without)}, 0);
  }
};
constexpr double kNearlyAll = 0.91;

TEST(Judge, AnEffectThatOnlyTakesWhatNoiseExplainsDoesNotMatter) {
  const NoisyFriction friction;
  EXPECT_TRUE(friction.beside(0, {}).matters);
  EXPECT_FALSE(friction.beside(kNearlyAll, {}).matters);
}

TEST(Judge, AnEffectMattersIfWithoutItANumberIsFarBeyondItsTolerance) {
  const NoisyFriction friction;
  const Trial t = friction.beside(kNearlyAll, baseline_parameters(friction.model));
  EXPECT_EQ(t.prior_cost, 0);
  EXPECT_TRUE(t.matters);
}

/// A large push has been found, and little is left beside it: friction that acts at all times, or an error of the push.
TEST(Judge, ASmallEffectMattersBesideALargeOneIfItActsAtOtherTimes) {
  const ArmModel model = first_joints(2);
  PlacedEffect push = place_neutral_effect(*find_effect("external_force"), model.nominal, 1);
  push.p[0] = 10, push.p[1] = 2, push.p[2] = 4, push.p[4] = 0;
  PlacedEffect friction = place_neutral_effect(*find_effect("motor_friction"), model.nominal, 1);
  friction.p[0] = 0.4 * model.nominal.joint[1].motor_coulomb;
  ArmModel robot = model;
  robot.effects = {push, friction};
  const Evidence evidence(make_records(simulate(motion(robot, 12)).measured, model, {}), model);
  const Score first = evidence.score({model.nominal, {}});
  const Judge judge(evidence, model, {});
  const auto trial = [&](const Hypothesis& without, const PlacedEffect& small) {
    Hypothesis with = without;
    with.effects.push_back(small);
    const Score before = evidence.score(without), after = evidence.score(with);
    // It would be too small if the push had acted all the time.
    EXPECT_LT(before.mean_square[1] - after.mean_square[1],
              std::pow(kRule.form_misfit, 2) * (first.mean_square[1] - before.mean_square[1]));
    return judge.trial(with, {without, before}, with.effects.size() - 1);
  };
  const Trial of_friction = trial({model.nominal, {push}}, friction);
  EXPECT_TRUE(of_friction.is_judged());
  EXPECT_TRUE(of_friction.matters);
  PlacedEffect weak = push, rest = push;
  weak.p[0] = 9.5, rest.p[0] = 0.5;
  const Trial of_error = trial({model.nominal, {friction, weak}}, rest);
  EXPECT_TRUE(of_error.is_judged());
  EXPECT_FALSE(of_error.matters);
}

/// True if an eccentricity of the joint's encoder matters beside another effect, which was found.
bool eccentricity_matters_beside(const std::string& name, double size, double amplitude) {
  const ArmModel model = first_joints(1);
  PlacedEffect found = place_neutral_effect(*find_effect(name), model.nominal, 0), eccentricity;
  found.p[0] += size;
  eccentricity = place_neutral_effect(*find_effect("encoder_eccentricity"), model.nominal, 0);
  eccentricity.p[0] = amplitude, eccentricity.p[2] = 8;
  ArmModel robot = model;
  robot.effects = {found, eccentricity};
  const Evidence evidence(make_records(simulate(motion(robot, 6)).measured, model, {}), model);
  const Hypothesis without{model.nominal, {found}}, with{model.nominal, robot.effects};
  return Judge(evidence, model, {}).trial(with, {without, evidence.score(without)}, 1).matters;
}

/// The joint moves by 0.2 rad RMS about 0.8 rad.
TEST(Judge, ASmallEffectDoesNotMatterBesideALargeOneThatVaries) {
  EXPECT_TRUE(eccentricity_matters_beside("capstan_ratio", 0, 2e-4));
  EXPECT_FALSE(eccentricity_matters_beside("capstan_ratio", 0.3, 2e-4));
  EXPECT_TRUE(eccentricity_matters_beside("capstan_ratio", 0.3, 1e-2));
}

TEST(Judge, AnEffectThatOnlyChangesANumberMissesLess) {
  const ArmParameters<double> arm = first_joints(1).nominal;
  EXPECT_EQ(misfit_of(place_effect(*find_effect("capstan_ratio"), arm, 0)), kRule.number_misfit);
  EXPECT_EQ(misfit_of(place_effect(*find_effect("backlash"), arm, 0)), kRule.form_misfit);
  EXPECT_LT(kRule.number_misfit, kRule.form_misfit);
}

/// What is missed of a constant is a constant.
TEST(Judge, ASmallEffectMattersBesideALargeConstant) {
  EXPECT_TRUE(eccentricity_matters_beside("encoder_offset", 0.3, 2e-4));
}

TEST(Judge, AnEffectLeansOnABoundIfItEndsThere) {
  const ArmModel model = first_joints(1);
  const double most = find_effect("encoder_offset")->parameters(model.nominal, 0)[0].upper;
  const auto leans = [&](double size) {
    PlacedEffect offset = place_neutral_effect(*find_effect("encoder_offset"), model.nominal, 0);
    offset.p[0] = size;
    ArmModel robot = model;
    robot.effects = {offset};
    const Evidence evidence(make_records(simulate(motion(robot, 3)).measured, model, {}), model);
    const Hypothesis h{model.nominal, robot.effects};
    return Judge(evidence, model, {}).leans_on_a_bound({h, evidence.score(h)});
  };
  EXPECT_FALSE(leans(0.5 * most));
  EXPECT_TRUE(leans(most));
}

/// Motor 1 has more Coulomb friction than its model. A part was found as an effect: is the rest its error of form?
TEST(Judge, TheMisfitOfAnEffectCountsWhatTheModelsNumbersHadHidden) {
  const ArmModel model = first_joints(2);
  const double change = 0.6 * model.nominal.joint[0].motor_coulomb;
  ArmModel robot = model;
  robot.nominal.joint[0].motor_coulomb += change;
  const Evidence evidence(make_records(simulate(motion(robot, 6)).measured, model, {}), model);
  const Judge judge(evidence, model, {});
  const auto friction = [&](double share) {
    PlacedEffect e = place_neutral_effect(*find_effect("motor_friction"), model.nominal, 0);
    e.p[0] = share * change;
    return e;
  };
  const auto rest_matters = [&](double found) {
    const Hypothesis without{model.nominal, {friction(found)}},
        with{model.nominal, {friction(found), friction(1 - found)}};
    return judge.trial(with, {without, evidence.score(without)}, 1).matters;
  };
  EXPECT_TRUE(rest_matters(0.8));
  EXPECT_FALSE(rest_matters(0.93)) << "less than a tenth of what the effect does";
  // Refitted, the model alone leaves so little that the rest would be more than a tenth of what the effect removes.
  Hypothesis refitted{model.nominal, {}};
  refitted.nominal.joint[0].motor_coulomb += 0.8 * change;
  const double left = evidence.score(refitted).mean_square[0],
               rest = evidence.score({model.nominal, {friction(0.93)}}).mean_square[0];
  EXPECT_GT(rest, std::pow(kRule.form_misfit, 2) * (left - rest));
}

TEST(Judge, TheCostOfAFitIsThatOfItsResidualsAndOfItsNumbers) {
  const ArmModel model = first_joints(1);
  const Evidence& evidence = made_evidence();
  const std::vector<FitParameter> numbers = baseline_parameters(model);
  const Judge judge(evidence, model, numbers);
  Scored given, moved;
  given.hypothesis = moved.hypothesis = {model.nominal, {}};
  given.score.fit_mean_square = {1, 1};
  moved.score.fit_mean_square = {0.1, 20};
  set_parameter(moved.hypothesis, numbers[0], numbers[0].upper);
  EXPECT_NEAR(judge.prior_cost(moved.hypothesis), 2, 1e-9) << "two deviations are the whole tolerance";
  double expected = 2;
  for (const int c : {0, 1}) {
    const double floor_square = std::pow(evidence.floor()[c], 2);
    expected += evidence.fit_count(c) / (2 * evidence.correlated_rows(c)) *
                std::log((moved.score.fit_mean_square[c] + floor_square) / (1 + floor_square));
  }
  EXPECT_NEAR(judge.cost(moved) - judge.cost(given), expected, 1e-9);
}

/// Of the joint, in floors; nothing of the torque.
std::vector<double> squares_of_joint(double floors) { return {0, std::pow(floors * made_evidence().floor()[1], 2)}; }

TEST(Judge, ARestIsMoreThanThreeFloorsAndWhatTheEffectsMayMiss) {
  const auto is_rest = [](double floors, const std::vector<double>& misfit) {
    Score score;
    score.mean_square = squares_of_joint(floors);
    return significant_rest(made_evidence(), score, misfit) == std::vector<bool>{false, true};
  };
  EXPECT_FALSE(is_rest(2.99, {}));
  EXPECT_TRUE(is_rest(3.01, {}));
  // Beside a misfit of four floors it is five.
  EXPECT_FALSE(is_rest(4.99, squares_of_joint(4)));
  EXPECT_TRUE(is_rest(5.01, squares_of_joint(4)));
}

TEST(Judge, NoiseExplainsATenthMoreThanTheFloor) {
  EXPECT_FALSE(is_beyond_noise(made_evidence(), squares_of_joint(1.09), 1));
  EXPECT_TRUE(is_beyond_noise(made_evidence(), squares_of_joint(1.11), 1));
  EXPECT_FALSE(is_beyond_noise(made_evidence(), squares_of_joint(1.11), 0));
}

TEST(Judge, TheMostExplainedChannelIsThatOfTheMostSquaredFloors) {
  // In squared floors of the torque and of the joint, whose floor is a smaller number.
  const auto most = [](std::pair<double, double> without, std::pair<double, double> with) {
    const std::vector<double>& floor = made_evidence().floor();
    Score before, after;
    before.mean_square = {without.first * floor[0] * floor[0], without.second * floor[1] * floor[1]};
    after.mean_square = {with.first * floor[0] * floor[0], with.second * floor[1] * floor[1]};
    return most_explained_channel(made_evidence(), after, before);
  };
  ASSERT_LT(made_evidence().floor()[1], 0.5 * made_evidence().floor()[0]) << "the test shows nothing";
  EXPECT_EQ(most({10, 10}, {7, 4}), 1);
  EXPECT_EQ(most({10, 10}, {4, 7}), 0);
  EXPECT_EQ(most({10, 10}, {12, 9.5}), 1);
  EXPECT_FALSE(most({10, 10}, {11, 12}));
}

TEST(Judge, ATrialOfWhatCannotBeIntegratedIsUnusable) {
  const ArmModel model = first_joints(1);
  const Judge judge(made_evidence(), model, {});
  const Scored without{{model.nominal, {}}, made_evidence().score({model.nominal, {}})};
  Hypothesis with = without.hypothesis;
  with.effects = {place_effect(*find_effect("encoder_offset"), model.nominal, 0)};
  Hypothesis broken = with;
  broken.nominal.joint[0].mass = std::nan("");
  Scored lost = without;
  lost.score.finite = false;
  EXPECT_TRUE(judge.trial(with, without, 0).usable);
  EXPECT_FALSE(judge.trial(broken, without, 0).usable);
  EXPECT_FALSE(judge.trial(with, lost, 0).usable);
}

/// A trial of an effect of this size, without which the zero of the joint's sensor would be far off.
Trial trial_of_size(const char* name, double size) {
  const ArmModel model = first_joints(1);
  const Hypothesis given{model.nominal, {}};
  Hypothesis with = given, without = given;
  with.effects = {place_neutral_effect(*find_effect(name), model.nominal, 0)};
  with.effects[0].p[0] = size;
  without.nominal.joint[0].joint_encoder_offset += 0.3;
  return Judge(made_evidence(), model, {}).trial(with, {without, made_evidence().score(without)}, 0);
}

TEST(Judge, AnEffectWithinTheToleranceOfItsNumberIsARefit) {
  const ArmModel model = first_joints(1);
  const double tolerance = model.joints[0].tolerances.friction * model.nominal.joint[0].motor_coulomb;
  // A gap has no number in the model: a hundredth of a typical one is none.
  const double none = 0.01 * find_effect("backlash")->parameters(model.nominal, 0)[0].typical;
  for (const auto& [name, allowed] : {std::pair("motor_friction", tolerance), std::pair("backlash", none)}) {
    const Trial little = trial_of_size(name, 0.99 * allowed), more = trial_of_size(name, 1.01 * allowed);
    ASSERT_TRUE(little.is_judged() && more.is_judged()) << name;
    EXPECT_TRUE(little.is_refit) << name;
    EXPECT_FALSE(more.is_refit) << name;
  }
  EXPECT_TRUE(trial_of_size("motor_friction", -0.99 * tolerance).is_refit);
  EXPECT_FALSE(trial_of_size("motor_friction", -1.01 * tolerance).is_refit);
}

TEST(Judge, AGainIsLessByTheFurtherPriorCostOfTheNumbers) {
  const ArmModel model = first_joints(1);
  const std::vector<FitParameter> numbers = baseline_parameters(model);
  const Judge judge(made_evidence(), model, numbers);
  const Hypothesis given{model.nominal, {}};
  Hypothesis moved = given;
  set_parameter(moved, numbers[0], numbers[0].upper);  // two deviations
  const Score score = made_evidence().score(given);
  EXPECT_NEAR(judge.gain_over({moved, score}, {given, score}), -2, 1e-9);
  EXPECT_NEAR(judge.gain_over({given, score}, {moved, score}), 2, 1e-9);
  moved.effects = {place_effect(*find_effect("encoder_offset"), model.nominal, 0)};
  EXPECT_NEAR(judge.trial(moved, {given, score}, 0).prior_cost, 2, 1e-9);
}

}  // namespace
}  // namespace halyard

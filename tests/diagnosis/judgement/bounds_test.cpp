/// Effects whose sizes or shapes end where what is plausible ends.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "diagnosis/judgement/judge.h"
#include "diagnosis/search/naming.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

PlacedEffect placed_at_first(const char* name, const ArmModel& model, const std::vector<double>& p) {
  PlacedEffect e = place_neutral_effect(*find_effect(name), model.nominal, 0);
  for (std::size_t i = 0; i < p.size(); ++i) e.p[i] = p[i];
  return e;
}

Scenario six_seconds(const ArmModel& robot) { return motion(robot, 6); }

/// Moves from 3 s to 7 s of 10 s.
Scenario with_a_rest(const ArmModel& robot) {
  constexpr double kFirst = 3, kLast = 7;
  Scenario s = motion(robot, 10);
  JointTrajectory& t = s.trajectory[0];
  t.kind = JointTrajectory::Kind::samples;
  for (double time = kFirst; time <= kLast + 1e-9; time += 0.02) {
    t.sample_time.push_back(time);
    t.sample_position.push_back(t.center + 0.3 * std::pow(std::sin(2 * std::numbers::pi * (time - kFirst) / 4), 3));
  }
  return s;
}

/// An arm of one joint that has this effect, and the verdict on it.
struct Found {
  ArmModel model = first_joints(1);
  PlacedEffect effect;
  Evidence evidence;
  Judge judge{evidence, model, {}};

  Found(const char* name, const std::vector<double>& p, Scenario (*moves)(const ArmModel&) = six_seconds)
      : effect(placed_at_first(name, model, p)), evidence(make_records(record(moves), model, {}), model) {}
  Log record(Scenario (*moves)(const ArmModel&)) const {
    ArmModel robot = model;
    robot.effects = {effect};
    return simulate(moves(robot)).measured;
  }
  Trial trial(const PlacedEffect& of) const {
    const Hypothesis with{model.nominal, {of}}, without{model.nominal, {}};
    return judge.trial(with, {without, evidence.score(without)}, 0);
  }
};

TEST(Bounds, CountForAShapeOnlyIfItActs) {
  // Friction that settles at this rate, rad/s per s, from a start that never changes without a rate.
  constexpr double kFastest = 1;
  const Found constant("friction_drift", {0, 0.6, kFastest, 0}), settling("friction_drift", {-0.5, 0.8, kFastest, 0});
  const Trial of_constant = constant.trial(constant.effect), of_settling = settling.trial(settling.effect);
  ASSERT_TRUE(of_constant.is_judged() && of_settling.is_judged());
  EXPECT_FALSE(of_constant.at_bound);
  EXPECT_TRUE(of_settling.at_bound);
}

TEST(Bounds, CountForDryFrictionThatVanishes) {
  // Quadratic drag looks like viscous friction without any dry friction.
  const double all = first_joints(1).nominal.joint[0].joint_coulomb;
  const Found none("joint_friction", {-all, 1}), little("joint_friction", {-0.9 * all, 1});
  const Trial of_none = none.trial(none.effect), of_little = little.trial(little.effect);
  ASSERT_TRUE(of_none.is_judged() && of_little.is_judged());
  EXPECT_TRUE(of_none.at_bound);
  EXPECT_FALSE(of_little.at_bound);
}

TEST(Bounds, OfAPushAreThoseOfTheRecordIfTheDataCannotTellThem) {
  // What acts before the first compared sample, half a second after the first, changes nothing.
  const Found always("external_force", {2, -1, 7}), later("external_force", {2, 2, 7});
  PlacedEffect shorter = always.effect;
  shorter.p[1] = 0.4, shorter.p[2] = 6;
  const Trial of_always = always.trial(shorter), of_later = later.trial(later.effect);
  ASSERT_TRUE(of_always.is_judged() && of_later.is_judged());
  EXPECT_TRUE(of_always.at_bound);
  EXPECT_FALSE(of_later.at_bound);
}

TEST(Bounds, OfAPushAreThoseOfTheMotionToo) {
  // Rest, motion, rest: what begins and ends with the motion belongs to it.
  const Found moving("external_force", {2, 3, 7}, with_a_rest), resting("external_force", {2, 2, 7}, with_a_rest);
  const Trial of_moving = moving.trial(moving.effect), of_resting = resting.trial(resting.effect);
  ASSERT_TRUE(of_moving.is_judged() && of_resting.is_judged());
  EXPECT_TRUE(of_moving.at_bound);
  EXPECT_FALSE(of_resting.at_bound);
}

TEST(Bounds, OfAPushThatIsNotThereDoNotCount) {
  // A wall in the middle of the motion. The instants of the push beside it mean nothing.
  const double middle = motion(first_joints(1), 6).trajectory[0].center;
  const Found wall("external_force", {0, 2, 2, 0, 5, middle});
  const Trial of_wall = wall.trial(wall.effect);
  ASSERT_TRUE(of_wall.is_judged());
  EXPECT_FALSE(of_wall.at_bound);
}

TEST(Bounds, OfOnePartLeaveTheOtherPartOfAnEffect) {
  const ArmModel model = first_joints(1);
  const double fastest = find_effect("stribeck")->parameters(model.nominal, 0)[3].upper;
  const Found both("stribeck", {0.4, 0.05, 5e-3, fastest});
  std::vector<FitParameter> given_up;
  const auto left = both.judge.without_sizes_at_bound({both.model.nominal, {both.effect}}, 0, given_up);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->effects[0].p[0], 0.4);
  EXPECT_EQ(left->effects[0].p[2], 0) << "the motor's friction rises only above all speeds";
  std::vector<std::string> names;
  for (const FitParameter& p : given_up) names.push_back(p.name);
  EXPECT_EQ(names, (std::vector<std::string>{"motor_rise", "motor_speed"}));
  const Found one("stribeck", {0, 0.05, 5e-3, fastest});
  EXPECT_FALSE(one.judge.without_sizes_at_bound({one.model.nominal, {one.effect}}, 0, given_up)) << "nothing is left";
}

TEST(Bounds, LeaveACandidateAmongTheRivalsOfAName) {
  const Found friction("motor_friction", {4e-3});
  std::vector<Trial> trials = {friction.trial(friction.effect), friction.trial(friction.effect)};
  const Hypothesis without{friction.model.nominal, {}};
  const Scored scored{without, friction.evidence.score(without)};
  const auto naming = [&] {
    return Competition(friction.evidence, friction.model, friction.judge, scored, trials).naming({0, {0}});
  };
  EXPECT_NEAR(naming().weight, 0.5, 1e-6);
  trials[1].at_bound = true;
  ASSERT_EQ(naming().alternatives.size(), 1u);
  const double odds = std::exp(-kRule.at_bound);
  EXPECT_NEAR(naming().alternatives[0].probability, odds / (1 + odds), 1e-6);
  EXPECT_FALSE(naming().surer);
  trials[1].prior_cost -= kRule.by_chance + 1;
  EXPECT_TRUE(naming().surer) << "it cannot be named, and is more probable than the name";
  trials[1].at_bound = false;
  EXPECT_FALSE(naming().surer) << "it can be named";
}

TEST(Bounds, OfAPushAreNearIfItLastsNearlyAllTheTime) {
  // It ends 0.15 s early, which the data tell, and begins 0.03 s late: less than a twentieth of 4.25 s together.
  const auto short_motion = [](const ArmModel& robot) { return motion(robot, 4.25); };
  const Found nearly("external_force", {10, 0.03, 4.1}, short_motion);
  const Trial trial = nearly.trial(nearly.effect);
  ASSERT_TRUE(trial.is_judged());
  EXPECT_TRUE(trial.at_bound);
}

TEST(Bounds, OfAShapeLeaveAnEffectAmongTheRivalsOfWhatItIsThere) {
  const Found softer("stiffness", {0.5, 1});
  const PlacedEffect loop = place_effect(*find_effect("hysteresis"), softer.model.nominal, 0);
  std::vector<Trial> trials = {softer.trial(softer.effect), softer.trial(softer.effect)};
  trials[1].effect = loop;
  trials[1].is_another = true;
  const Hypothesis without{softer.model.nominal, {}};
  const Scored scored{without, softer.evidence.score(without)};
  const auto naming = [&] {
    return Competition(softer.evidence, softer.model, softer.judge, scored, trials).naming({0, {0}});
  };
  ASSERT_EQ(naming().alternatives.size(), 1u);
  const auto cost = [&](const PlacedEffect& e) { return prior_cost_of(e, softer.model.nominal); };
  const double odds = std::exp(cost(softer.effect) - cost(loop) - kRule.cost_of_a_limit);
  EXPECT_NEAR(naming().alternatives[0].probability / naming().weight, odds, 1e-6);
  EXPECT_FALSE(naming().surer);
  trials[1].prior_cost += 2;  // the damping of the cable is another effect's number
  EXPECT_NEAR(naming().alternatives[0].probability / naming().weight, odds * std::exp(-2), 1e-6);
  trials[1].effect = place_effect(*find_effect("friction_drift"), softer.model.nominal, 0);
  EXPECT_TRUE(naming().alternatives.empty()) << "it is not this effect there";
}

}  // namespace
}  // namespace halyard

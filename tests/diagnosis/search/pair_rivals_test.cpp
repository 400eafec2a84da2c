#include "diagnosis/search/pair_rivals.h"

#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

PlacedEffect of_a_pair(const std::string& name, const std::vector<double>& p, int joint = 0) {
  PlacedEffect e = place_neutral_effect(*find_effect(name), first_joints(joint + 1).nominal, joint);
  std::copy(p.begin(), p.end(), e.p);
  return e;
}

/// A round that the first effect led; the others gained this share of it.
Round led_by(const PlacedEffect& first, const std::vector<PlacedEffect>& others, double share) {
  Round round;
  const auto add = [&](const PlacedEffect& effect, double gain) {
    Trial t;
    t.effect = effect, t.usable = true, t.p_value = 1e-6, t.gain = gain;
    round.trials.push_back(t);
  };
  add(first, 10);
  for (const PlacedEffect& other : others) add(other, 10 * share);
  return round;
}

/// An arm of few joints, and what a search may have found.
class PairRivalsTest : public testing::Test {
 protected:
  explicit PairRivalsTest(const std::vector<PlacedEffect>& truth, int joints = 1) : model_(first_joints(joints)) {
    ArmModel robot = model_;
    robot.effects = truth;
    evidence_.emplace(make_records(simulate(motion(robot, 8)).measured, model_, {}), model_);
    refitter_.emplace(*evidence_, model_, 0);
    judge_.emplace(*evidence_, model_, refitter_->numbers());
  }
  Attribution named(const std::vector<PlacedEffect>& effects) const {
    const Hypothesis h{model_.nominal, effects};
    Attribution found;
    found.final_fit = refitter_->refit(h, evidence_->score(h));
    found.final_score = evidence_->score(found.final_fit.hypothesis);
    found.namings.assign(effects.size(), {1, {}});
    return found;
  }
  void weigh(Attribution& found, int most_effects = 6) const {
    PairRivals(*evidence_, model_, *refitter_, *judge_, 0, {.most_effects = most_effects}).weigh(found);
  }

  ArmModel model_;
  std::optional<Evidence> evidence_;
  std::optional<Refitter> refitter_;
  std::optional<Judge> judge_;
};

/// More friction with its presliding, at a motor; and the same at the joint.
std::vector<PlacedEffect> at_motor(int joint = 0) {
  return {of_a_pair("motor_friction", {0.012}, joint), of_a_pair("motor_presliding", {0.8, 0.4}, joint)};
}
std::vector<PlacedEffect> at_joint(int joint = 0) {
  return {of_a_pair("joint_friction", {1}, joint), of_a_pair("joint_presliding", {0.8, 0.004}, joint)};
}
std::vector<PlacedEffect> both(std::vector<PlacedEffect> a, const std::vector<PlacedEffect>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

class FrictionAndPresliding : public PairRivalsTest {
 protected:
  FrictionAndPresliding() : PairRivalsTest(at_motor()) {}
  Attribution weighed(Attribution found, const std::vector<PlacedEffect>& rivals, double share = 0.8) const {
    const auto& names = found.final_fit.hypothesis.effects;
    found.rounds = {led_by(names[0], {rivals[0]}, share), led_by(names[1], {rivals[1]}, share)};
    weigh(found);
    return found;
  }
};

TEST_F(FrictionAndPresliding, OnTheWrongSideAreReplacedTogether) {
  const Attribution right = weighed(named(at_joint()), at_motor());
  const std::vector<PlacedEffect>& effects = right.final_fit.hypothesis.effects;
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ(effects[0].effect->name(), "motor_friction");
  EXPECT_EQ(effects[1].effect->name(), "motor_presliding");
  for (const Naming& naming : right.namings) {
    EXPECT_GT(naming.weight, 0.9);
    EXPECT_EQ(naming.alternatives.size(), 1u) << "the name before";
  }
}

TEST_F(FrictionAndPresliding, OnTheRightSideKeepTheirNames) {
  const Attribution same = weighed(named(at_motor()), at_joint());
  EXPECT_EQ(same.final_fit.hypothesis.effects[0].effect->name(), "motor_friction");
  ASSERT_EQ(same.namings[0].alternatives.size(), 1u) << "the rivals were not tried: the test shows nothing";
  EXPECT_LT(same.namings[0].alternatives[0].probability, 0.1);
}

TEST_F(FrictionAndPresliding, HaveNoRivalsThatGainedLittle) {
  const Attribution after = weighed(named(at_joint()), at_motor(), 0.4);
  EXPECT_EQ(after.final_fit.hypothesis.effects[0].effect->name(), "joint_friction");
  EXPECT_EQ(after.namings[0].weight, 1);
  EXPECT_TRUE(after.namings[0].alternatives.empty());
}

class FrictionAndPreslidingOfTwo : public PairRivalsTest {
 protected:
  FrictionAndPreslidingOfTwo() : PairRivalsTest(both(at_motor(0), at_motor(1)), 2) {}
};

TEST_F(FrictionAndPreslidingOfTwo, JointsAreReplacedAtBoth) {
  Attribution found = named(both(at_joint(0), at_joint(1)));
  for (int k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < 2; ++i) found.rounds.push_back(led_by(at_joint(k)[i], {at_motor(k)[i]}, 0.8));
  weigh(found);
  std::vector<std::string> names;
  for (const PlacedEffect& e : found.final_fit.hypothesis.effects) names.push_back(effect_label(e));
  EXPECT_EQ(names, (std::vector<std::string>{"motor_friction of joint 1", "motor_presliding of joint 1",
                                             "motor_friction of joint 2", "motor_presliding of joint 2"}));
}

std::vector<PlacedEffect> at_motor_and_pulleys() {
  return {of_a_pair("motor_friction", {0, -6e-6, -0.3}), of_a_pair("pulley_friction", {0.08, 0.4})};
}
PlacedEffect at_the_joint() { return of_a_pair("joint_friction", {0.4, 0, -0.1}); }

/// Frictions of the motor and of its pulleys.
class FrictionOfMotorAndPulleys : public PairRivalsTest {
 protected:
  FrictionOfMotorAndPulleys() : PairRivalsTest(at_motor_and_pulleys()) {}
};

TEST_F(FrictionOfMotorAndPulleys, TakeThePlaceOfThatOfTheJoint) {
  Attribution found = named({at_the_joint()});
  found.rounds = {led_by(found.final_fit.hypothesis.effects[0], at_motor_and_pulleys(), 0.7)};
  weigh(found);
  const std::vector<PlacedEffect>& effects = found.final_fit.hypothesis.effects;
  ASSERT_EQ(effects.size(), 2u);
  ASSERT_EQ(found.namings.size(), 2u);
  EXPECT_EQ(effects[0].effect->name(), "motor_friction");
  EXPECT_EQ(effects[1].effect->name(), "pulley_friction");
  for (const Naming& naming : found.namings) {
    EXPECT_GT(naming.weight, 0.9);
    ASSERT_EQ(naming.alternatives.size(), 1u);
    EXPECT_EQ(naming.alternatives[0].effect.effect->name(), "joint_friction") << "the name before";
  }
}

TEST_F(FrictionOfMotorAndPulleys, AreNoAlternativesOfThemselves) {
  Attribution found = named({at_the_joint()});
  found.namings[0] = {0.7, {{at_motor_and_pulleys()[0], 0.2, false}, {at_motor_and_pulleys()[1], 0.1, false}}};
  found.rounds = {led_by(found.final_fit.hypothesis.effects[0], at_motor_and_pulleys(), 0.7)};
  weigh(found);
  ASSERT_EQ(found.namings.size(), 2u);
  for (const Naming& naming : found.namings) {
    ASSERT_EQ(naming.alternatives.size(), 1u);
    EXPECT_EQ(naming.alternatives[0].effect.effect->name(), "joint_friction");
    EXPECT_LE(naming.weight, 1);
  }
}

/// The name has lost its place to an effect that gains less than it had gained before.
TEST_F(FrictionOfMotorAndPulleys, AreFoundAmongTheRivalsOfANameThatStays) {
  Attribution found = named({at_the_joint()});
  const PlacedEffect name = found.final_fit.hypothesis.effects[0];
  Round revision = led_by(of_a_pair("hysteresis", {0.3}), at_motor_and_pulleys(), 0.7);
  revision.trials.push_back(led_by(name, {}, 1).trials[0]);
  revision.revised = name;
  revision.name_stays = true;
  found.rounds = {revision};
  weigh(found);
  EXPECT_EQ(found.final_fit.hypothesis.effects.size(), 2u);
}

TEST_F(FrictionOfMotorAndPulleys, OfARoundWithOtherTolerancesAreNoRivals) {
  for (const double factor : {1.0, 2.0}) {
    Attribution found = named({at_the_joint()});
    found.rounds = {led_by(found.final_fit.hypothesis.effects[0], at_motor_and_pulleys(), 0.7), Round{}};
    found.rounds[1].tolerance_factor = factor;
    weigh(found);
    EXPECT_EQ(found.final_fit.hypothesis.effects.size(), 1u) << factor;
  }
}

TEST_F(FrictionOfMotorAndPulleys, DoNotExceedTheMostEffects) {
  Attribution found = named({at_the_joint()});
  found.rounds = {led_by(found.final_fit.hypothesis.effects[0], at_motor_and_pulleys(), 0.7)};
  weigh(found, 1);
  EXPECT_EQ(found.final_fit.hypothesis.effects.size(), 1u);
}

/// Beside the friction of the motor, effects that resemble the friction of the pulleys share what that has.
TEST_F(FrictionOfMotorAndPulleys, CountsEveryPairForANameThatStandsInSeveral) {
  Attribution found = named({at_the_joint()});
  std::vector<PlacedEffect> rivals = at_motor_and_pulleys();
  rivals.push_back(place_effect(*find_effect("hysteresis"), model_.nominal, 0));
  found.rounds = {led_by(found.final_fit.hypothesis.effects[0], rivals, 0.7)};
  weigh(found);
  ASSERT_EQ(found.namings.size(), 2u);
  const Naming &motor = found.namings[0], &pulleys = found.namings[1];
  ASSERT_EQ(pulleys.alternatives.size(), 2u);
  EXPECT_EQ(pulleys.alternatives[1].effect.effect->name(), "hysteresis");
  EXPECT_GT(pulleys.alternatives[1].probability, 1e-3) << "the test shows nothing";
  EXPECT_NEAR(motor.weight, pulleys.weight + pulleys.alternatives[1].probability, 1e-9);
  for (const Naming& naming : {motor, pulleys}) {
    double sum = naming.weight;
    for (const Alternative& a : naming.alternatives) sum += a.probability;
    EXPECT_NEAR(sum, 1, 1e-6);
  }
}

/// Friction of the joint alone.
class FrictionOfJoint : public PairRivalsTest {
 protected:
  FrictionOfJoint() : PairRivalsTest({at_the_joint()}) {}
};

TEST_F(FrictionOfJoint, KeepsItsNameBesideTwoThatAreNotNeeded) {
  Attribution found = named({at_the_joint()});
  found.rounds = {led_by(found.final_fit.hypothesis.effects[0], at_motor_and_pulleys(), 0.7)};
  weigh(found);
  ASSERT_EQ(found.final_fit.hypothesis.effects.size(), 1u);
  EXPECT_EQ(found.final_fit.hypothesis.effects[0].effect->name(), "joint_friction");
  EXPECT_GT(found.namings[0].weight, 0.9);
  EXPECT_EQ(found.namings[0].alternatives.size(), 2u) << "the rivals were not tried: the test shows nothing";
}

TEST(PairRivals, AreNoneIfTheRoundSaysNothingOfOneOfThem) {
  const ArmModel model = first_joints(1);
  const Refitter refitter(made_evidence(), model, 0);
  const Judge judge(made_evidence(), model, refitter.numbers());
  const PlacedEffect name = at_the_joint();
  const auto name_is_unchallenged = [&](const std::function<void(Round&)>& spoil) {
    Attribution found;
    found.final_fit.hypothesis = {model.nominal, {name}};
    found.final_score = made_evidence().score(found.final_fit.hypothesis);
    found.namings = {{1, {}}};
    found.rounds = {led_by(name, at_motor_and_pulleys(), 0.7)};
    spoil(found.rounds[0]);
    PairRivals(made_evidence(), model, refitter, judge, 0, {}).weigh(found);
    return found.final_fit.hypothesis.effects.size() == 1 && found.namings[0].weight == 1 &&
           found.namings[0].alternatives.empty();
  };
  EXPECT_FALSE(name_is_unchallenged([](Round&) {})) << "the test shows nothing";
  EXPECT_TRUE(name_is_unchallenged([](Round& r) { r.at_once = true; }));
  EXPECT_TRUE(name_is_unchallenged([](Round& r) { r.trials.clear(); }));
  EXPECT_TRUE(name_is_unchallenged([](Round& r) { std::swap(r.trials[0], r.trials[1]); })) << "another one led it";
  EXPECT_TRUE(name_is_unchallenged([](Round& r) { r.trials[0].gain = 0; })) << "the name has gained nothing";
  EXPECT_TRUE(name_is_unchallenged([](Round& r) { r.trials[2].gain = 4.9; })) << "less than half";
  EXPECT_TRUE(name_is_unchallenged([](Round& r) { r.trials[2].p_value = 0.06; })) << "not significant";
  EXPECT_TRUE(name_is_unchallenged([](Round& r) { r.trials[2].is_refit = true; }));
  EXPECT_TRUE(name_is_unchallenged([](Round& r) { r.trials[2].is_another = true; }));
  EXPECT_TRUE(name_is_unchallenged([](Round& r) { r.trials[2].effect.joint = 1; })) << "at another joint";
  EXPECT_TRUE(name_is_unchallenged([&](Round& r) { r.trials[2].effect = name; })) << "it is found already";
  EXPECT_TRUE(name_is_unchallenged([&](Round& r) {
    r.revised = name, r.name_stays = true;
    r.trials.erase(r.trials.begin());
  })) << "a name that stays, and did not compete";
}

TEST_F(FrictionOfMotorAndPulleys, MakeANameDoubtfulIfTheyAreMoreProbableAndCannotBeNamed) {
  Attribution found = named({at_the_joint()});
  found.rounds = {led_by(found.final_fit.hypothesis.effects[0], at_motor_and_pulleys(), 0.7)};
  PairRivals(*evidence_, model_, *refitter_, *judge_, 0, {.significance = 0}).weigh(found);
  ASSERT_EQ(found.final_fit.hypothesis.effects.size(), 1u) << "nothing is significant at this level";
  const Naming& naming = found.namings.at(0);
  EXPECT_LT(naming.weight, 0.1);
  ASSERT_EQ(naming.alternatives.size(), 2u);
  EXPECT_NEAR(naming.alternatives[0].probability, naming.alternatives[1].probability, 1e-12) << "they share its weight";
  EXPECT_NEAR(naming.weight + 2 * naming.alternatives[0].probability, 1, 1e-6);
  ASSERT_TRUE(naming.surer);
  EXPECT_EQ(naming.surer->effect->name(), "motor_friction");
}

}  // namespace
}  // namespace halyard

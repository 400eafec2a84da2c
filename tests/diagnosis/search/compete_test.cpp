#include "diagnosis/search/compete.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

/// An arm of one joint with an effect that its model does not have: more friction at its motor.
class CompeteTest : public testing::Test {
 protected:
  CompeteTest() : CompeteTest("motor_friction", 0.012) {}
  CompeteTest(const std::string& effect, double size) {
    ArmModel robot = model_;
    robot.effects = {of_size(effect, size)};
    evidence_.emplace(make_records(simulate(motion(robot, 8)).measured, model_, {}), model_);
    basis_.emplace(*evidence_, model_, 1, 0);
    without_ = fitted({});
  }
  PlacedEffect of_size(const std::string& name, double first) const {
    PlacedEffect e = place_neutral_effect(*find_effect(name), model_.nominal, 0);
    e.p[0] = first;
    return e;
  }
  Found fitted(const std::vector<PlacedEffect>& effects) const {
    const Hypothesis h{model_.nominal, effects};
    return basis_->refitted(h, evidence_->score(h));
  }
  /// The place of the name, for which `candidates` compete.
  RoundOutcome outcome(const std::optional<Standing>& standing, const std::vector<std::string>& candidates) const {
    CandidateRound round(*evidence_, basis_->model, basis_->refitter, basis_->judge, without_.scored(),
                         without_.fit.hypothesis, "a round", quiet_);
    std::vector<PlacedEffect> effects;
    for (const std::string& name : candidates) effects.push_back(place_effect(*find_effect(name), model_.nominal, 0));
    return compete(*evidence_, *basis_, 0.01, round, without_.scored(), effects, standing);
  }

  const ArmModel model_ = first_joints(1);
  const SearchProgress quiet_ = [](const std::string&, double) {};
  std::optional<Evidence> evidence_;
  std::optional<Basis> basis_;
  Found without_;
};

TEST_F(CompeteTest, TheRightCandidateWins) {
  const RoundOutcome o = outcome({}, {"joint_friction", "motor_friction"});
  ASSERT_TRUE(o.won);
  EXPECT_EQ(o.won->effect.effect->name(), "motor_friction");
  EXPECT_FALSE(o.won->is_standing);
}

TEST_F(CompeteTest, ARightNameKeepsItsPlaceAndItsFit) {
  const Found found = fitted({of_size("motor_friction", 0.01)});
  const RoundOutcome o = outcome(Standing{found, 0}, {"joint_friction", "motor_friction"});
  ASSERT_TRUE(o.won);
  EXPECT_EQ(o.won->effect.effect->name(), "motor_friction");
  EXPECT_TRUE(o.won->is_standing);
  EXPECT_EQ(o.won->fit.hypothesis.effects[0].p[0], found.fit.hypothesis.effects[0].p[0]);
}

TEST_F(CompeteTest, AWrongNameLosesItsPlaceToTheRightOne) {
  const Found found = fitted({of_size("joint_friction", 0.5)});
  const RoundOutcome o = outcome(Standing{found, 0}, {"joint_friction", "motor_friction"});
  ASSERT_TRUE(o.won);
  EXPECT_EQ(o.won->effect.effect->name(), "motor_friction");
}

TEST_F(CompeteTest, ANameWithABadFitGetsABetterOne) {
  Found found = fitted({of_size("motor_friction", 0.01)});
  found.fit.hypothesis.effects[0].p[0] *= 0.8;
  found.score = evidence_->score(found.fit.hypothesis);
  const RoundOutcome o = outcome(Standing{found, 0}, {"motor_friction"});
  ASSERT_TRUE(o.won);
  EXPECT_FALSE(o.won->is_standing);
  EXPECT_NEAR(o.won->fit.hypothesis.effects[0].p[0], 0.012, 0.0004);
}

TEST_F(CompeteTest, ANameThatIsNoCandidateCompetesAllTheSame) {
  const Found found = fitted({of_size("motor_friction", 0.01)});
  const RoundOutcome o = outcome(Standing{found, 0}, {"joint_friction"});
  ASSERT_TRUE(o.won);
  EXPECT_TRUE(o.won->is_standing);
}

class CompeteOfASofterCable : public CompeteTest {
 protected:
  CompeteOfASofterCable() : CompeteTest("stiffness", 0.3) {}
};

TEST_F(CompeteOfASofterCable, IsNearlyLostToALoopThatYieldsAtOnce) {
  const RoundOutcome o = outcome({}, {"stiffness", "hysteresis"});
  ASSERT_TRUE(o.won);
  EXPECT_EQ(o.won->effect.effect->name(), "stiffness");
  ASSERT_EQ(o.won->naming.alternatives.size(), 1u);
  // The log cannot tell: what is left are their prior costs (cost_of_a_limit of decision_rule.h).
  EXPECT_NEAR(o.won->naming.alternatives[0].probability, 0.35, 0.1);
}

TEST_F(CompeteOfASofterCable, GivesALoopWithABadFitABetterOne) {
  Found found = fitted({of_size("hysteresis", 0.6)});
  found.fit.hypothesis.effects[0].p[0] = 0.5;
  found.score = evidence_->score(found.fit.hypothesis);
  const RoundOutcome o = outcome(Standing{found, 0}, {"stiffness"});
  ASSERT_TRUE(o.won);
  EXPECT_FALSE(o.won->is_standing);
  EXPECT_EQ(o.won->effect.effect->name(), "stiffness");
  ASSERT_EQ(o.won->naming.alternatives.size(), 1u);
  EXPECT_NEAR(o.won->naming.alternatives[0].effect.p[0], 0.7, 0.02);
}

TEST(CandidatesBeside, AreNoneOfWhichTheMotionHasTooFewPeriods) {
  const ArmModel model = first_joints(1);
  const Log log = log_along(4, 100, [](double t) { return 0.8 - 0.03 * std::cos(1.7 * t); });
  const Evidence evidence(make_records(log, model, {}), model);
  const auto has = [&](const Evidence& of, const std::string& name) {
    return std::ranges::any_of(candidates_beside(of, {model.nominal, {}}, model.nominal),
                               [&](const PlacedEffect& e) { return e.effect->name() == name; });
  };
  EXPECT_TRUE(has(made_evidence(), "encoder_eccentricity"));
  EXPECT_FALSE(has(evidence, "encoder_eccentricity"));
  EXPECT_TRUE(has(evidence, "encoder_offset"));
}

TEST(CandidatesBeside, MayRepeatAPushASlipAndARippleAndNothingElse) {
  const ArmModel model = first_joints(1);
  Hypothesis found{model.nominal, {}};
  for (const char* name : {"motor_friction", "hysteresis", "torque_ripple", "cable_slip", "external_force"})
    found.effects.push_back(place_effect(*find_effect(name), model.nominal, 0));
  std::vector<std::string> repeated;
  for (const PlacedEffect& c : candidates_beside(made_evidence(), found, model.nominal))
    if (std::ranges::any_of(found.effects, [&](const PlacedEffect& e) { return same_name(e, c); }))
      repeated.push_back(c.effect->name());
  EXPECT_EQ(repeated, (std::vector<std::string>{"torque_ripple", "cable_slip", "external_force"}));
}

}  // namespace
}  // namespace halyard

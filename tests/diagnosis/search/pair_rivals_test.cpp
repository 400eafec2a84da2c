#include "diagnosis/search/pair_rivals.h"

#include <gtest/gtest.h>

#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

PlacedEffect beside_its_pair(const std::string& name, const std::vector<double>& p) {
  PlacedEffect e = place_neutral_effect(*find_effect(name), first_joints(1).nominal, 0);
  std::copy(p.begin(), p.end(), e.p);
  return e;
}

/// A round that the first effect led; the second gained this share of it.
Round led_by(const PlacedEffect& first, const PlacedEffect& second, double share) {
  Round round;
  for (const auto& [effect, gain] : {std::pair(first, 10.0), std::pair(second, 10.0 * share)}) {
    Trial t;
    t.effect = effect, t.usable = true, t.p_value = 1e-6, t.gain = gain;
    round.trials.push_back(t);
  }
  return round;
}

/// More friction with its presliding, at the motor of the only joint; and the same at the joint.
class FrictionAndPresliding : public testing::Test {
 protected:
  FrictionAndPresliding() : model_(first_joints(1)) {
    ArmModel robot = model_;
    robot.effects = at_motor_;
    evidence_.emplace(make_records(simulate(motion(robot, 8)).measured, model_, {}), model_);
    refitter_.emplace(*evidence_, model_, 0);
    judge_.emplace(*evidence_, model_, refitter_->numbers());
  }
  Attribution named(const std::vector<PlacedEffect>& effects) const {
    const Hypothesis h{model_.nominal, effects};
    Attribution found;
    found.final_fit = refitter_->refit(h, evidence_->score(h));
    found.final_score = evidence_->score(found.final_fit.hypothesis);
    found.namings = {{1, {}}, {1, {}}};
    return found;
  }
  Attribution weighed(Attribution found, const std::vector<PlacedEffect>& rivals, double share = 0.8) const {
    const auto& names = found.final_fit.hypothesis.effects;
    found.rounds = {led_by(names[0], rivals[0], share), led_by(names[1], rivals[1], share)};
    PairRivals(*evidence_, model_, *refitter_, *judge_, 0, 0.01).weigh(found);
    return found;
  }

  const std::vector<PlacedEffect> at_motor_ = {beside_its_pair("motor_friction", {0.012}),
                                               beside_its_pair("motor_presliding", {0.8, 0.4})};
  const std::vector<PlacedEffect> at_joint_ = {beside_its_pair("joint_friction", {1}),
                                               beside_its_pair("joint_presliding", {0.8, 0.004})};
  ArmModel model_;
  std::optional<Evidence> evidence_;
  std::optional<Refitter> refitter_;
  std::optional<Judge> judge_;
};

TEST_F(FrictionAndPresliding, OnTheWrongSideAreReplacedTogether) {
  const Attribution right = weighed(named(at_joint_), at_motor_);
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
  const Attribution same = weighed(named(at_motor_), at_joint_);
  EXPECT_EQ(same.final_fit.hypothesis.effects[0].effect->name(), "motor_friction");
  ASSERT_EQ(same.namings[0].alternatives.size(), 1u) << "the rivals were not tried: the test shows nothing";
  EXPECT_LT(same.namings[0].alternatives[0].probability, 0.1);
}

TEST_F(FrictionAndPresliding, HaveNoRivalsThatGainedLittle) {
  const Attribution after = weighed(named(at_joint_), at_motor_, 0.4);
  EXPECT_EQ(after.final_fit.hypothesis.effects[0].effect->name(), "joint_friction");
  EXPECT_EQ(after.namings[0].weight, 1);
  EXPECT_TRUE(after.namings[0].alternatives.empty());
}

}  // namespace
}  // namespace halyard

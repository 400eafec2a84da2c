#include "diagnosis/search/attribution.h"

#include <gtest/gtest.h>

#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/message_of.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

PlacedEffect of_first_joint(const std::string& name, const ArmModel& model, const std::vector<double>& p) {
  PlacedEffect e = place_neutral_effect(*find_effect(name), model.nominal, 0);
  std::copy(p.begin(), p.end(), e.p);
  return e;
}

const PlacedEffect* found(const Attribution& a, const std::string& name) {
  for (const PlacedEffect& e : a.final_fit.hypothesis.effects)
    if (e.effect->name() == name) return &e;
  return nullptr;
}

/// The motor reaches its no-load speed. Its ripple is small beside what it loses there, but it acts at other times.
TEST(Attribution, FindsALimitOfTheMotorsSpeedAndTheSmallRippleBesideIt) {
  const ArmModel model = first_joints(1);
  ArmModel robot = model;
  robot.effects = {of_first_joint("actuator_saturation", model, {1, 0.3, 150}),
                   of_first_joint("torque_ripple", model, {0.002, 0.003, 4})};
  const Evidence evidence(make_records(simulate(motion(robot, 12)).measured, model, {}), model);
  ASSERT_GT(evidence.greatest_speed(0), 140) << "the limit is not reached";
  const Attribution a = attribute(evidence, model, {}, {});
  ASSERT_TRUE(found(a, "actuator_saturation"));
  ASSERT_TRUE(found(a, "torque_ripple"));
  EXPECT_EQ(a.final_fit.hypothesis.effects.size(), 2u);
  // 1 % of the speed changes the limit by 3 mN m; the ripple is fitted within a tenth of that.
  EXPECT_NEAR(found(a, "actuator_saturation")->p[2], 150, 1.5);
  EXPECT_NEAR(found(a, "torque_ripple")->p[0], 0.002, 0.0003);
}

/// Where the model's numbers are far off, what is not linear in them hides a small ripple at first. Its frequencies are
/// those of noise, but it is none.
TEST(Attribution, FindsASmallRippleBesideNumbersThatAreOff) {
  const ArmModel model = first_joints(1);
  ArmModel robot = model;
  JointParameters<double>& j = robot.nominal.joint[0];
  j.joint_coulomb *= 1.2, j.joint_viscous *= 0.8, j.motor_coulomb *= 1.2, j.capstan_radius *= 1.002;
  robot.effects = {of_first_joint("torque_ripple", model, {0.00027, 0.0008, 2})};
  const Evidence evidence(make_records(simulate(motion(robot, 12)).measured, model, {}), model);
  const Attribution a = attribute(evidence, model, {}, {});
  ASSERT_TRUE(found(a, "torque_ripple"));
  EXPECT_EQ(a.final_fit.hypothesis.effects.size(), 1u);
  EXPECT_EQ(found(a, "torque_ripple")->p[2], 2);
}

/// A model whose joint's sensor resolves a hundredth of a radian, and a log of which that sensor alone is compared. It
/// is off by so much.
struct Coarse {
  ArmModel model = first_joints(1);
  Evidence evidence;

  explicit Coarse(double off) : evidence(records(off), model) {}
  std::vector<Record> records(double off) {
    model.nominal.joint[0].joint_encoder_resolution = 0.01;
    Log log = log_along(4, 100, slow_swing);
    for (double& q : log.joint_position[0]) q -= off;
    return make_records(log, model, {});
  }
};

TEST(Attribution, OfALogThatItsModelExplainsHasNoRounds) {
  const Coarse log(0);
  const Attribution a = attribute(log.evidence, log.model, {}, {});
  EXPECT_TRUE(a.rounds.empty());
  EXPECT_TRUE(a.namings.empty());
  EXPECT_TRUE(a.final_fit.hypothesis.effects.empty());
  EXPECT_EQ(a.no_effect, 1);
  EXPECT_EQ(a.tolerance_factor, 1);
}

TEST(Attribution, AddsNoEffectIfNoneIsAllowed) {
  const Coarse log(0.1);
  const Attribution a = attribute(log.evidence, log.model, {.most_effects = 0}, {});
  EXPECT_TRUE(is_beyond_noise(log.evidence, a.final_score.mean_square, 1)) << "the test shows nothing";
  EXPECT_TRUE(a.rounds.empty());
  EXPECT_TRUE(a.final_fit.hypothesis.effects.empty());
}

TEST(Attribution, RefusesAModelThatCannotBePredicted) {
  Coarse log(0);
  log.model.effects.assign(70, place_effect(*find_effect("motor_presliding"), log.model.nominal, 0));
  const std::string told = message_of([&] { attribute(log.evidence, log.model, {}, {}); });
  EXPECT_NE(told.find("its effects have 70 internal states"), std::string::npos) << told;
}

TEST(AllCandidates, OfASingleJointAreNoneAtAllJointsAlike) {
  const auto places_of_delay = [](int joints) {
    std::vector<EffectPlace> places;
    for (const PlacedEffect& c : all_candidates(first_joints(joints).nominal))
      if (c.effect->name() == "delay") places.push_back(c.joint);
    return places;
  };
  EXPECT_EQ(places_of_delay(1), std::vector<EffectPlace>{0});
  EXPECT_EQ(places_of_delay(2), (std::vector<EffectPlace>{kWholeArm, 0, 1}));
}

}  // namespace
}  // namespace halyard

/// What an identification estimates, and the priors that it begins with.

#include "estimators/identification/unknowns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/arm_runs.h"

namespace halyard {
namespace {

const Weight* weight_named(const Unknowns& unknowns, const std::string& key) {
  const auto found = std::ranges::find(unknowns.weights, key, &Weight::key);
  return found == unknowns.weights.end() ? nullptr : &*found;
}

TEST(Unknowns, WhatIsAskedForComesFirstInTheOrderOfTheModel) {
  ArmModel model = raven2();
  model.joints[0].tolerances.stiffness = 0.15;
  model.joints[1].tolerances.coupling = 0.03;
  const Unknowns all = list_unknowns(model, {"joint2.coupling.joint1", "joint1.cable.stiffness"});
  ASSERT_EQ(all.asked, 2);
  EXPECT_EQ(all.learnt, 2);
  EXPECT_EQ(all.weights[0].key, "joint1.cable.stiffness");
  EXPECT_EQ(all.weights[1].key, "joint2.coupling.joint1");
  ASSERT_EQ(all.reach.size(), 2u);
  EXPECT_DOUBLE_EQ(all.reach[0], 0.15 * model.nominal.joint[0].stiffness);
  EXPECT_DOUBLE_EQ(all.reach[1], 0.03 * std::abs(model.nominal.joint[1].coupling[0]));
  EXPECT_EQ(all.learnt_weights().size(), 2u);
}

TEST(Unknowns, ANumberThatHasOneSignIsUncertainByHalfADecadeOnALogarithmicScale) {
  const ArmModel model = raven2();
  const Unknowns all = list_unknowns(model, {"joint1.cable.stiffness"});
  EXPECT_TRUE(all.weights[0].logarithmic);
  EXPECT_EQ(all.weights[0].nominal, model.nominal.joint[0].stiffness);
  EXPECT_EQ(all.weights[0].scale, 0.5);
}

TEST(Unknowns, ANumberOfEitherSignIsUncertainByHalfOfIt) {
  ArmModel model = raven2();
  model.nominal.joint[1].com[1] = -0.04;
  const Unknowns all = list_unknowns(model, {"joint2.link.com.y"});
  EXPECT_FALSE(all.weights[0].logarithmic);
  EXPECT_EQ(all.weights[0].nominal, -0.04);
  EXPECT_DOUBLE_EQ(all.weights[0].scale, 0.02);
}

TEST(Unknowns, ACouplingIsUncertainByThreeTenthsOfIt) {
  ArmModel model = raven2();
  model.nominal.joint[1].coupling[0] = -0.2;
  const Unknowns all = list_unknowns(model, {"joint2.coupling.joint1"});
  EXPECT_FALSE(all.weights[0].logarithmic);
  EXPECT_EQ(all.weights[0].nominal, -0.2);
  EXPECT_DOUBLE_EQ(all.weights[0].scale, 0.06);
}

TEST(Unknowns, ACouplingOfZeroIsThoughtOfAsAPulleyOfTenMillimetresOrAnEqualPath) {
  ArmModel model = chain_of(4, 1);
  model.nominal.joint[3].pulley_radius = -0.05;
  const Unknowns of_revolute = list_unknowns(model, {"joint4.coupling.joint2"}),
                 of_prismatic = list_unknowns(model, {"joint4.coupling.joint3"});
  EXPECT_EQ(of_revolute.weights[0].nominal, 0);
  EXPECT_DOUBLE_EQ(of_revolute.weights[0].scale, 0.3 * 0.01 / 0.05);
  EXPECT_DOUBLE_EQ(of_prismatic.weights[0].scale, 0.3 * 1 / 0.05);
}

TEST(Unknowns, EncodersWithUnknownZeroAreUncertainByFiftyMilliradiansOrTenMillimetresOfTheJoint) {
  ArmModel model = raven2();
  EXPECT_FALSE(has_unknown_zeros(model));
  model.nominal.joint[1].motor_zero_known = false;
  model.nominal.joint[1].motor_encoder_offset = 0.7;
  model.nominal.joint[2].joint_zero_known = false;
  EXPECT_TRUE(has_unknown_zeros(model));
  const Unknowns all = list_unknowns(model, {"joint1.cable.stiffness"});
  ASSERT_EQ(all.asked, 1);
  ASSERT_EQ(all.learnt, 3);
  const JointParameters<double>&second = model.nominal.joint[1], &third = model.nominal.joint[2];
  EXPECT_EQ(all.weights[1].key, "joint2.motor.zero");
  EXPECT_EQ(all.weights[1].nominal, 0.7);
  EXPECT_DOUBLE_EQ(all.weights[1].scale * second.motor_travel(), 0.05 * std::abs(second.pulley_radius));
  EXPECT_EQ(all.weights[2].key, "joint3.motor.zero");
  EXPECT_DOUBLE_EQ(all.weights[2].scale * third.motor_travel(), 0.01 * std::abs(third.pulley_radius));
  model.nominal.joint[2].drive = Drive::none;
  EXPECT_EQ(list_unknowns(model, {"joint1.cable.stiffness"}).learnt, 2);
}

TEST(Unknowns, OtherNumbersHaveHalfTheirToleranceAndMoveByTenOfThemOrThreeQuarters) {
  ArmModel model = raven2();
  for (JointDescription& j : model.joints) j.tolerances.stiffness = 0.1, j.tolerances.friction = 0.02;
  model.joints[2].tolerances.friction = 0;
  const Unknowns all = list_unknowns(model, {"joint1.cable.stiffness"});
  const Eigen::VectorXd bound = all.bound();
  EXPECT_EQ(bound(0), std::numeric_limits<double>::infinity());
  const Weight* stiffness = weight_named(all, "joint2.cable.stiffness");
  ASSERT_NE(stiffness, nullptr);
  EXPECT_DOUBLE_EQ(stiffness->scale, 0.05 * model.nominal.joint[1].stiffness);
  EXPECT_NEAR(bound(stiffness - all.weights.data()), 0.75 / 0.05, 1e-12);
  const Weight* friction = weight_named(all, "joint1.friction.coulomb");
  ASSERT_NE(friction, nullptr);
  EXPECT_DOUBLE_EQ(friction->scale, 0.01 * model.nominal.joint[0].joint_coulomb);
  EXPECT_EQ(bound(friction - all.weights.data()), 20);
  EXPECT_EQ(weight_named(all, "joint3.friction.coulomb"), nullptr);  // exact
}

TEST(Unknowns, OfADriveWhoseRatioIsAskedForNoOtherLengthIsUncertain) {
  ArmModel model = raven2();
  for (JointDescription& joint : model.joints) joint.tolerances.length = 0.01;
  for (const char* key : {"joint1.motor.gear_ratio", "joint1.motor.capstan_radius", "joint1.cable.pulley_radius"}) {
    const Unknowns all = list_unknowns(model, {key});
    ASSERT_EQ(all.asked, 1);
    EXPECT_EQ(all.weights[0].key, key);
    const auto is_other = [&](const Weight& w) {
      return w.key.starts_with("joint1.") && (w.key.ends_with("_radius") || w.key.ends_with("_ratio"));
    };
    EXPECT_EQ(std::ranges::count_if(all.weights, is_other), 1) << "the one asked for";
    EXPECT_NE(weight_named(all, "joint2.motor.capstan_radius"), nullptr) << "of another drive";
  }
}

TEST(Unknowns, OfADriveItIsTheCapstanAndOfALinkTheMassThatIsUncertain) {
  const Unknowns all = list_unknowns(raven2(), {"joint1.cable.stiffness"});
  for (const char* key : {"joint1.motor.capstan_radius", "joint2.link.mass"})
    EXPECT_NE(weight_named(all, key), nullptr) << key;
  const JointParameters<double> j = raven2().nominal.joint[0];
  EXPECT_DOUBLE_EQ(weight_named(all, "joint1.motor.capstan_radius")->scale,
                   1.5 * raven2().joints[0].tolerances.length * j.capstan_radius)
      << "half of what its three lengths may be off";
  for (const char* key : {"joint1.motor.gear_ratio", "joint1.cable.pulley_radius", "joint1.cable.tension",
                          "joint2.link.com.x", "joint2.link.inertia"})
    EXPECT_EQ(weight_named(all, key), nullptr) << key;
  EXPECT_EQ(std::ranges::count(all.weights, "joint1.cable.stiffness", &Weight::key), 1);
}

}  // namespace
}  // namespace halyard

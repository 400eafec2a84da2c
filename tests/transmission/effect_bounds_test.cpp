/// Bounds and typical sizes of effects, where physics gives them.

#include <gtest/gtest.h>

#include <string>

#include "tests/support/effect_runs.h"
#include "transmission/effects/typical_size.h"

namespace halyard {
namespace {

/// The parameter of an effect at the first joint.
EffectParameter bounds_of(const std::string& effect, const std::string& name, const ArmParameters<double>& arm) {
  for (const EffectParameter& p : find_effect(effect)->parameters(arm, 0))
    if (p.name == name) return p;
  ADD_FAILURE() << effect << " has no " << name;
  return {};
}

TEST(EffectBounds, OfAShareAreZeroAndOne) {
  const ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  const EffectParameter share = bounds_of("pulley_friction", "motor_share", arm);
  EXPECT_EQ(share.lower, 0);
  EXPECT_EQ(share.upper, 1);
}

TEST(EffectBounds, OfARatioReachAsFarDownAsUp) {
  const ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  for (const char* name : {"stiffness_ratio", "damping_ratio"}) {
    const EffectParameter ratio = bounds_of("stiffness", name, arm);
    EXPECT_DOUBLE_EQ(ratio.lower * ratio.upper, 1) << name;
  }
}

TEST(EffectBounds, OfAContactAreTheStiffnessOfItsCable) {
  ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  JointParameters<double>& j = arm.joint[0];
  j.type = JointType::revolute;
  j.drive = Drive::cable;
  j.stiffness = 1e9;  // far above what friction would ask for
  const EffectParameter contact = bounds_of("external_force", "contact_stiffness", arm);
  const double at_joint = 2 * j.stiffness * j.pulley_radius * j.pulley_radius;  // two runs on one pulley
  EXPECT_DOUBLE_EQ(contact.upper, at_joint);
  EXPECT_DOUBLE_EQ(contact.lower, -at_joint);
  // A typical contact that is pressed by 0.1 rad pushes back with five times the typical force.
  EXPECT_DOUBLE_EQ(0.1 * contact.typical, 5 * bounds_of("external_force", "force", arm).typical);
}

TEST(EffectBounds, OfARippleAreInProportionToTheMotorsFriction) {
  ArmParameters<double> arm = random_arm(5, CableLaw::linear), rough = arm;
  arm.joint[0].motor_coulomb = 10;  // far above what the joint would ask for
  rough.joint[0].motor_coulomb = 20;
  for (const char* name : {"cosine", "sine"}) {
    const EffectParameter ripple = bounds_of("torque_ripple", name, arm),
                          twice = bounds_of("torque_ripple", name, rough);
    EXPECT_DOUBLE_EQ(twice.typical, 2 * ripple.typical) << name;
    EXPECT_DOUBLE_EQ(twice.upper, 2 * ripple.upper) << name;
    EXPECT_EQ(ripple.lower, -ripple.upper) << name << ": its phase is any";
  }
}

TEST(EffectBounds, AJointWithoutFrictionMayHaveTwoPercentOfItsWeight) {
  JointParameters<double> j;
  j.type = JointType::revolute;
  j.drive = Drive::none;
  j.mass = 3;
  j.com[0] = 0.3, j.com[1] = 0.4;  // 0.5 m from the axis' origin
  EXPECT_DOUBLE_EQ(typical_joint_friction(j), 0.02 * 9.81 * 3 * 0.5);
  j.type = JointType::prismatic;
  EXPECT_DOUBLE_EQ(typical_joint_friction(j), 0.02 * 9.81 * 3);
}

TEST(EffectBounds, FrictionOfTheJointIsAsMuchPowerAtTheMotor) {
  JointParameters<double> j;
  j.type = JointType::revolute;
  j.drive = Drive::cable;
  j.motor_coulomb = 0.2;
  j.pulley_radius = 0.5;
  const double rate = 3, joint_rate = rate * j.motor_travel() / j.pulley_radius;
  const double from_motor = typical_joint_friction(j);
  EXPECT_DOUBLE_EQ(from_motor * joint_rate, j.motor_coulomb * rate);
  j.motor_coulomb = 0;
  j.joint_coulomb = from_motor;
  EXPECT_DOUBLE_EQ(typical_motor_friction(j) * rate, from_motor * joint_rate);
}

TEST(EffectBounds, OfAnEncodersErrorIsAnyShareAtTheJointAndNoneUnlessTold) {
  const ArmParameters<double> arm = random_arm(5, CableLaw::linear);  // the first joint moves other cables
  const EffectParameter share = bounds_of("encoder_offset", "at_joint", arm);
  EXPECT_EQ(share.neutral, 0);
  EXPECT_EQ(share.typical, 0);
  EXPECT_EQ(share.lower, 0);
  EXPECT_EQ(share.upper, 1);
}

TEST(EffectBounds, OfViscousFrictionFollowTheCoulombLevelWhereTheModelHasNone) {
  ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  arm.joint[0].motor_viscous = arm.joint[0].joint_viscous = 0;
  EXPECT_DOUBLE_EQ(bounds_of("motor_friction", "viscous_change", arm).typical,
                   0.3 * 0.002 * typical_motor_friction(arm.joint[0]));
  EXPECT_DOUBLE_EQ(bounds_of("joint_friction", "viscous_change", arm).typical,
                   0.3 * 0.02 * typical_joint_friction(arm.joint[0]));
}

TEST(EffectBounds, ACableIsStretchedByItsTensionOrByHalfTheFrictionOfItsJoint) {
  JointParameters<double> j;
  j.joint_coulomb = 0.6;
  j.pulley_radius = 0.05;
  j.stiffness = 1e4;
  EXPECT_DOUBLE_EQ(typical_stretch(j), 0.5 * 0.6 / 0.05 / 1e4);
  j.tension = 20;
  EXPECT_DOUBLE_EQ(typical_stretch(j), 20 / 1e4);
}

TEST(EffectBounds, AGapIsThreeHundredthsOfTheCapstanOrTenStretches) {
  JointParameters<double> j;  // a gear has a radius of 1
  j.tension = 20;
  j.stiffness = 1e4;
  EXPECT_DOUBLE_EQ(typical_half_gap(j), 10 * 20 / 1e4);
  j.capstan_radius = 0.01;
  EXPECT_DOUBLE_EQ(typical_half_gap(j), 0.03 * 0.01);
}

TEST(EffectBounds, SizesOfAJointWithoutNumbersAreAboveZero) {
  JointParameters<double> j;
  j.stiffness = 1e12;
  EXPECT_EQ(typical_joint_friction(j), 1e-6);
  EXPECT_EQ(typical_stretch(j), 1e-9);
}

TEST(EffectBounds, OfAPayloadAreThoseOfItsLinkOrOfTheArm) {
  ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  for (const double mass : {0.5, 0.0}) {
    arm.joint[2].mass = mass;
    const double whole = mass > 0 ? mass : 1e-3;
    const EffectParameter payload = bounds_of("payload", "mass", arm);
    EXPECT_EQ(payload.neutral, 0) << mass;
    EXPECT_DOUBLE_EQ(payload.typical, 0.1 * whole) << mass;
    EXPECT_DOUBLE_EQ(payload.lower, -0.9 * whole) << mass;
    const double links = arm.joint[0].mass + arm.joint[1].mass + mass;
    EXPECT_DOUBLE_EQ(payload.upper, std::max(20 * whole, links)) << mass;
  }
}

}  // namespace
}  // namespace halyard

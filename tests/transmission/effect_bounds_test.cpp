/// Bounds and typical sizes of effects, where physics gives them.

#include <gtest/gtest.h>

#include <string>

#include "tests/support/effect_runs.h"

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

}  // namespace
}  // namespace halyard

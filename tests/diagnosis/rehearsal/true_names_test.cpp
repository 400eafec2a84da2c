#include "diagnosis/rehearsal/true_names.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/short_arm.h"

namespace halyard {
namespace {

NamedEffect told_name(const std::string& effect, EffectPlace joint) {
  return {{find_effect(effect), joint}, 0.9, {}, {}};
}

/// Whether each name is right about an arm with a backlash of joint 2, beside a `neither` stiffness of joint 1.
std::vector<bool> rights(const std::vector<NamedEffect>& names, int joints, bool* is_named = nullptr) {
  Rehearsal r;
  r.hidden = {{{find_effect("backlash"), 1}, true, false}};
  score_names(names, {{find_effect("stiffness"), 0}}, joints, r);
  if (is_named) *is_named = r.hidden[0].is_named;
  std::vector<bool> right;
  for (const RehearsedName& n : r.names) right.push_back(n.is_right);
  return right;
}

TEST(TrueNames, AreRightOnceAndOnlyAtTheirJoint) {
  bool is_named = false;
  EXPECT_EQ(rights({told_name("backlash", 0)}, 3, &is_named), std::vector<bool>{false});
  EXPECT_FALSE(is_named);
  EXPECT_EQ(rights({told_name("backlash", 1), told_name("backlash", 1)}, 3, &is_named),
            (std::vector<bool>{true, false}))
      << "a second name for the same effect";
  EXPECT_TRUE(is_named);
  EXPECT_EQ(rights({told_name("backlash", kWholeArm)}, 1), std::vector<bool>{true}) << "the arm is the joint";
}

TEST(TrueNames, ThatCountNeitherWayAreLeftOut) {
  EXPECT_TRUE(rights({told_name("stiffness", 0)}, 3).empty());
  EXPECT_EQ(rights({told_name("stiffness", 1)}, 3), std::vector<bool>{false});
}

TEST(TrueNames, OfNumbersBeyondTheirToleranceAreThoseOfTheEffectsThatChangeThem) {
  const ArmModel model = first_joints(2);
  EXPECT_TRUE(effects_beyond_tolerance(model, model.nominal).empty());
  ArmParameters<double> arm = model.nominal;
  arm.joint[1].stiffness *= 3;
  const std::vector<PlacedEffect> effects = effects_beyond_tolerance(model, arm);
  EXPECT_TRUE(
      std::ranges::any_of(effects, [](const PlacedEffect& e) { return effect_label(e) == "stiffness of joint 2"; }));
  EXPECT_FALSE(std::ranges::any_of(effects, [](const PlacedEffect& e) { return e.joint == 0; }));
}

}  // namespace
}  // namespace halyard

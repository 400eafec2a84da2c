#include "diagnosis/rehearsal/drawn_effect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/support/short_arm.h"

namespace halyard {
namespace {

const ArmModel& three_joints() {
  static const ArmModel model = first_joints(3);
  return model;
}

/// Calls visit(effect, parameters) of a hundred draws of the sizes and shapes of one effect of joint 1.
void for_draws(const char* name,
               const std::function<void(const PlacedEffect&, const std::vector<SearchedParameter>&)>& visit) {
  Random random(5, 6, 7);
  const MotionRange range{{1, 31}, std::vector<MotionRange::Range>(3, {-0.5, 0.5}), std::vector<double>(3, 1)};
  for (int i = 0; i < 100; ++i) {
    PlacedEffect e = place_neutral_effect(*find_effect(name), three_joints().nominal, 0);
    draw_parameters(e, three_joints(), range, random);
    visit(e, searched_parameters(e, three_joints()));
  }
}

std::size_t index_of(const std::string& name, const std::vector<SearchedParameter>& all) {
  return static_cast<std::size_t>(
      std::ranges::find_if(all, [&](const SearchedParameter& s) { return s.p.name == name; }) - all.begin());
}

TEST(DrawnSizes, AreHalfToThreeTimesTheTypicalOnesOfEitherSign) {
  double least = 10, most = 0;
  int negative = 0, absent = 0;
  for_draws("torque_scale", [&](const PlacedEffect& e, const std::vector<SearchedParameter>& all) {
    double size = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const EffectParameter& p = all[i].p;
      EXPECT_GE(e.p[i], p.lower);
      EXPECT_LE(e.p[i], p.upper);
      const double relative = (e.p[i] - p.neutral) / (p.typical - p.neutral);
      size = std::max(size, std::abs(relative));
      negative += relative < 0;
      absent += relative == 0;
    }
    least = std::min(least, size), most = std::max(most, size);
  });
  EXPECT_GE(least, 0.5) << "at least one size is there";
  EXPECT_LE(most, 3 + 1e-12);
  EXPECT_LT(least, 0.8);
  EXPECT_GT(most, 2);
  EXPECT_GT(negative, 20);
  EXPECT_GT(absent, 20) << "each of several is there by chance";
}

TEST(DrawnSizes, OfADriftAlwaysHaveARate) {
  for_draws("friction_drift", [](const PlacedEffect& e, const std::vector<SearchedParameter>& all) {
    const std::size_t rate = index_of("rate", all);
    EXPECT_NE(e.p[rate], all[rate].p.neutral) << "it would be motor_friction";
  });
}

TEST(DrawnSizes, OfAnInstantLieInTheFirstPartOfTheRecord) {
  for_draws("cable_slip", [](const PlacedEffect& e, const std::vector<SearchedParameter>& all) {
    const std::size_t time = index_of("time", all);
    EXPECT_GE(e.p[time], 1 + 0.1 * 30);
    EXPECT_LE(e.p[time], 1 + 0.7 * 30);
  });
}

TEST(DrawnEffect, IsNoneOfTheOthersAndAtTheJointThatIsAskedFor) {
  const Effect* const backlash = find_effect("backlash");
  const EffectPlace second = 1;
  const PlacedEffect other = place_effect(*backlash, three_joints().nominal, 0);
  Random random(1, 2, 3);
  for (int i = 0; i < 20; ++i) {
    const auto drawn = draw_effect({backlash}, three_joints(), {other}, nullptr, random);
    ASSERT_TRUE(drawn);
    EXPECT_NE(drawn->joint, other.joint);
    EXPECT_EQ(draw_effect({backlash}, three_joints(), {}, &second, random)->joint, second);
  }
  const EffectPlace first = 0;
  EXPECT_FALSE(draw_effect({backlash}, three_joints(), {other}, &first, random)) << "the only one is taken";
}

}  // namespace
}  // namespace halyard

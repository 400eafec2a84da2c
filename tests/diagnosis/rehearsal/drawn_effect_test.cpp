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

TEST(DrawnSizes, DoNotQuiteReachTheEndOfWhatIsPlausible) {
  double most = 0;
  for_draws("hysteresis", [&](const PlacedEffect& e, const std::vector<SearchedParameter>& all) {
    most = std::max(most, e.p[index_of("share", all)]);
  });
  // Of 0.4 up to three times as much is drawn; 0.95 is the bound.
  EXPECT_NEAR(most, 0.95 * 0.95, 1e-12);
}

TEST(DrawnSizes, OfOneSignAreThereInEveryDraw) {
  for_draws("backlash", [](const PlacedEffect& e, const std::vector<SearchedParameter>& all) {
    const std::size_t gap = index_of("half_gap", all);
    const double relative = e.p[gap] / all[gap].p.typical;
    EXPECT_GE(relative, 0.5 - 1e-12);
    EXPECT_LE(relative, 3 + 1e-12);
  });
}

TEST(DrawnSizes, AreOfEitherSignAndOftenSeveral) {
  int positive = 0, negative = 0, several = 0;
  for_draws("torque_scale", [&](const PlacedEffect& e, const std::vector<SearchedParameter>& all) {
    int sizes = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double change = e.p[i] - all[i].p.neutral;
      positive += change > 0, negative += change < 0, sizes += change != 0;
    }
    several += sizes == 2;
  });
  // Expected are 75, 75 and 50.
  EXPECT_GT(positive, 20);
  EXPECT_GT(negative, 20);
  EXPECT_GT(several, 20);
}

TEST(DrawnShapes, OrdersAreThoseOfWhichTheMotionHasEnoughPeriods) {
  double least = 100;
  for_draws("encoder_eccentricity", [&](const PlacedEffect& e, const std::vector<SearchedParameter>& all) {
    least = std::min(least, e.p[index_of("order", all)]);
  });
  // 1.5 periods in a radian of 2 π: 9.4 at least.
  EXPECT_GE(least, 10);
  EXPECT_LE(least, 12);
}

TEST(DrawnShapes, OfFrictionNearStandstillAreAQuarterOfTheFastestMotionAtMost) {
  constexpr double kFastest = 0.2;  // rad/s
  Random random(5, 6, 7);
  const MotionRange range{{1, 31}, std::vector<MotionRange::Range>(3, {-0.5, 0.5}), std::vector<double>(3, kFastest)};
  const JointParameters<double>& j = three_joints().nominal.joint[0];
  double joint = 0, motor = 0;
  for (int i = 0; i < 100; ++i) {
    PlacedEffect e = place_neutral_effect(*find_effect("stribeck"), three_joints().nominal, 0);
    draw_parameters(e, three_joints(), range, random);
    const std::vector<SearchedParameter> all = searched_parameters(e, three_joints());
    joint = std::max(joint, e.p[index_of("joint_speed", all)]);
    motor = std::max(motor, e.p[index_of("motor_speed", all)]);
  }
  // Starts are 15, 50 and 150 mrad/s, and 1.5, 5 and 15 rad/s; they are drawn up to twice as large.
  const double at_motor = 0.25 * kFastest * j.pulley_radius / std::abs(j.motor_travel());  // 6.8 rad/s
  EXPECT_LE(joint, 0.25 * kFastest + 1e-12);
  EXPECT_GT(joint, 0.6 * 0.25 * kFastest);
  EXPECT_LE(motor, at_motor + 1e-9);
  EXPECT_GT(motor, 0.5 * at_motor);
}

TEST(DrawnSizes, APushStopsATenthOfTheRecordAfterItsStartAndAContactLiesAmidTheMotion) {
  double lowest = 1, highest = -1;
  for_draws("external_force", [&](const PlacedEffect& e, const std::vector<SearchedParameter>& all) {
    const double start = e.p[index_of("start", all)], stop = e.p[index_of("stop", all)],
                 contact = e.p[index_of("contact_position", all)];
    // Of 30 s from 1 s on.
    EXPECT_GE(start, 1 + 0.1 * 30 - 1e-9);
    EXPECT_GE(stop - start, 0.1 * 30 - 1e-9);
    EXPECT_LE(stop, 1 + 0.6 * 30 + 1e-9);
    lowest = std::min(lowest, contact), highest = std::max(highest, contact);
  });
  // The joint is between ±0.5: from a fifth to four fifths of its way.
  EXPECT_GE(lowest, -0.3 - 1e-12);
  EXPECT_LE(highest, 0.3 + 1e-12);
  EXPECT_LT(lowest, -0.1);
  EXPECT_GT(highest, 0.1);
}

}  // namespace
}  // namespace halyard

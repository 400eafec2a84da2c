/// Sizes from which effects are detected, and where their shapes are put.

#include "diagnosis/planning/planner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

/// The planner of one joint in motion.
struct Planned {
  ArmModel model = first_joints(1);
  std::vector<Log> logs = {simulate(motion(model, 2)).measured};
  Planner planner{model, logs};

  PlacedEffect effect(const char* name) const { return place_effect(*find_effect(name), model.nominal, 0); }
};

const Planned& planned() {
  static const Planned once;
  return once;
}

TEST(Planner, PutsAPushIntoTheMiddleThirdAndAContactIntoTheMiddle) {
  const PlacedEffect shown = planned().planner.show(planned().effect("external_force")).limit.effect;
  const std::vector<Record> records = planned_records(planned().model, planned().logs);
  const Evidence evidence(records, planned().model);
  const Span time = evidence.time_span(), position = evidence.joint_span(0);
  EXPECT_NEAR(shown.p[1], time.first + (time.last - time.first) / 3, 1e-9);
  EXPECT_NEAR(shown.p[2], time.first + (time.last - time.first) * 2 / 3, 1e-9);
  EXPECT_NEAR(shown.p[5], (position.first + position.last) / 2, 1e-9);
}

TEST(Planner, AnEffectGrowsToItsBoundInTypicalSizes) {
  const PlacedEffect ratio = planned().effect("capstan_ratio");
  const EffectParameter p = ratio.effect->parameters(planned().model.nominal, 0)[0];
  ASSERT_EQ(p.neutral, 1);
  const Planner::Growing growing = planned().planner.show(ratio).growing;
  EXPECT_NEAR(1 + growing.largest * (p.typical - 1), p.upper, 1e-12);
  EXPECT_EQ(growing.at(2 * growing.largest).effects[0].p[0], p.upper);
  EXPECT_EQ(growing.at(0).effects[0].p[0], 1);
}

TEST(Planner, DetectsTheSameSizeWhateverItIsAShareOf) {
  const auto from = [](double offset) {
    PlacedEffect e = planned().effect("encoder_offset");
    e.p[0] = offset;  // rad
    return planned().planner.detected_from(planned().planner.scaled(e)) * offset;
  };
  const double least = from(0.01);
  ASSERT_LT(least, 0.01);
  // Shares are tried at ratios of 2^(1/8).
  for (const double larger : {1.3, 1.6}) EXPECT_NEAR(from(0.01 * larger) / least, 1, 0.1) << larger;
}

TEST(Planner, DoesNotExciteAnEffectOfWhichTheMotionHasTooFewPeriods) {
  const ArmModel model = first_joints(1);
  const auto eccentricity = [&](double half_way) {
    const Planner planner(model, {log_along(4, 100, [&](double t) { return 0.8 - half_way * std::cos(1.7 * t); })});
    PlacedEffect e = place_effect(*find_effect("encoder_eccentricity"), model.nominal, 0);
    const Planner::Shown shown = planner.show(e);
    e.p[2] = 64;  // the highest order
    return std::pair(shown, planner.is_searched(e));
  };
  const auto [large, large_is_searched] = eccentricity(0.3);
  EXPECT_TRUE(large.limit.excited);
  EXPECT_TRUE(large_is_searched);
  const auto [small, small_is_searched] = eccentricity(0.03);
  EXPECT_FALSE(small.limit.excited);
  EXPECT_TRUE(small.fitted.empty()) << "and imitates no other effect";
  EXPECT_FALSE(small_is_searched);
}

}  // namespace
}  // namespace halyard

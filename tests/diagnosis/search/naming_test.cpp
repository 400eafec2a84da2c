#include "diagnosis/search/naming.h"

#include <gtest/gtest.h>

#include "tests/support/short_arm.h"

namespace halyard {
namespace {

TEST(Naming, IsAsProbableAsItsNamesTogetherWhereOneOfThemIsRight) {
  Naming naming;
  naming.weight = 0.5;
  naming.alternatives = {{PlacedEffect{}, 0.3, false}, {PlacedEffect{}, 0.1, false}};
  EXPECT_DOUBLE_EQ(probability_of_any_name(naming, 0), 0.9);
  EXPECT_DOUBLE_EQ(probability_of_any_name(naming, 0.5), 0.45);
  EXPECT_DOUBLE_EQ(probability_of_any_name(naming, 1), 0);
}

TEST(Naming, TwoEffectsCostMoreThanOneWithTheirNumbers) {
  const ArmParameters<double> arm = first_joints(1).nominal;
  const auto cost = [&](const char* name) { return prior_cost_of(place_effect(*find_effect(name), arm, 0), arm); };
  EXPECT_NEAR(cost("backlash") - cost("capstan_ratio"), 2 * kRule.cost_of_number, 1e-12)
      << "3 numbers with its equation";
  EXPECT_GT(2 * cost("capstan_ratio"), cost("backlash"));
}

}  // namespace
}  // namespace halyard

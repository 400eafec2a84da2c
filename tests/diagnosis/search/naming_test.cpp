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

TEST(Naming, DoesNotCountSizesThatAreNeutral) {
  const ArmModel model = first_joints(1);
  PlacedEffect softer = place_neutral_effect(*find_effect("stiffness"), model.nominal, 0);  // three sizes
  EXPECT_EQ(numbers_added(softer, model.nominal), 1) << "its equation";
  softer.p[0] = 0.5;
  EXPECT_EQ(numbers_added(softer, model.nominal), 2);
  // Its size is neutral, but it has a shape.
  EXPECT_EQ(numbers_added(place_neutral_effect(*find_effect("cable_slip"), model.nominal, 0), model.nominal), 2);
  EXPECT_EQ(numbers_added(place_neutral_effect(*find_effect("payload"), model.nominal, kWholeArm), model.nominal), 0)
      << "it has no equation of its own";
}

}  // namespace
}  // namespace halyard

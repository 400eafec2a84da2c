#include "diagnosis/search/naming.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace halyard

#include "app/run_estimate.h"

#include <gtest/gtest.h>

namespace halyard {
namespace {

RunEstimate three_stages() { return RunEstimate({{"look", 2}, {"fit", 1}, {"report", 4}}); }

TEST(RunEstimate, OfTheFirstStageIsItsRestAndWhatIsUsual) {
  RunEstimate run = three_stages();
  EXPECT_DOUBLE_EQ(run.left("look of round 1", 0, 0), 2 + 1 + 4);
  EXPECT_DOUBLE_EQ(run.left("look of round 1", 0.25, 3), 9 + 1 + 4);
}

TEST(RunEstimate, ScalesWhatFollowsByWhatWasSeen) {
  RunEstimate run = three_stages();
  run.left("look of round 1", 0, 0);
  // Six seconds instead of two: all is three times as slow.
  EXPECT_DOUBLE_EQ(run.left("fit of round 1", 0, 6), 3 + 12);
}

TEST(RunEstimate, OfAStageThatComesAgainExpectsWhatItTookBefore) {
  RunEstimate run = three_stages();
  run.left("look of round 1", 0, 0);
  run.left("fit of round 1", 0, 6);
  EXPECT_DOUBLE_EQ(run.left("look of round 2", 0, 7), 6 + 1 + 4 * 7.0 / 3);
}

TEST(RunEstimate, OfAnUnknownStageIsItsRestAlone) {
  RunEstimate run = three_stages();
  run.left("something else", 0, 0);
  EXPECT_DOUBLE_EQ(run.left("something else", 0.5, 4), 4);
}

}  // namespace
}  // namespace halyard

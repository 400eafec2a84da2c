#include <gtest/gtest.h>

#include "bench/diagnosis/summary/acceptance.h"
#include "bench/diagnosis/summary/calibration.h"
#include "model/statistics/distributions.h"
#include "tests/bench/trials.h"

namespace halyard::blind {
namespace {

/// A trial whose revised model is wrong by this much at its only joint, where the others are by 1.
Result with_error(Kind kind, std::vector<TrueEffect> truth, double error) {
  Result r = trial(kind, std::move(truth), {});
  r.holdout = {.before = {1}, .after = {error}, .true_model = {1}, .informed = {1}, .rise = {0}};
  return r;
}

TEST(HoldOutOfTrials, IsComparedWithTheFitThatKnowsTheEffectsOnlyWhereThereAreSome) {
  std::vector<Result> ran(5, with_error(Kind::clean, {}, 1));
  ran.push_back(with_error(Kind::effect, {true_effect("backlash", 1)}, 3));
  const std::string table = acceptance_table(pointers(ran));
  EXPECT_NE(table.find("that of a fit which knows the effects, good sensors, arms with effects, mean of the joints: "
                       "median 3.000"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("the true model's, good sensors, mean of the joints: median 1.000"), std::string::npos) << table;
  ran.pop_back();
  EXPECT_EQ(acceptance_table(pointers(ran)).find("a fit which knows"), std::string::npos);
}

TEST(HoldOutOfTrials, RisesAboveTheGivenModelsErrorByMoreThanAPercentAndThreeDeviations) {
  Result r = with_error(Kind::clean, {}, 1.02);
  r.holdout.rise = {3.1};
  EXPECT_TRUE(rises_above_given(r));
  r.holdout.rise = {2.9};
  EXPECT_FALSE(rises_above_given(r));
  r = with_error(Kind::clean, {}, 1.005);
  r.holdout.rise = {30};
  EXPECT_FALSE(rises_above_given(r));
}

TEST(HoldOutOfTrials, RisesBySevenInAThousandByChance) {
  // The shares of chance that calibration.h tells have two digits.
  EXPECT_NEAR(t_quantile(9, 0.0075), 3, 0.01);
  EXPECT_NEAR(t_quantile(10, 0.0067), 3, 0.01);
}

}  // namespace
}  // namespace halyard::blind

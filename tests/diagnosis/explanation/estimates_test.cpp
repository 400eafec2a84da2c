/// Intervals of a final fit, as a diagnosis tells them: Student's, and within what a number can be.

#include "diagnosis/explanation/estimates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimators/distributions.h"

namespace halyard {
namespace {

/// A fit of one number with the deviation 1 by 9 blocks: its interval is ± t of 8 degrees of freedom.
struct OneNumber {
  Fit fit;
  const double half = t_quantile(8, 0.025);

  OneNumber(double value, double nominal, double lower, double upper, std::optional<std::size_t> effect, bool shape) {
    FitParameter p;
    p.name = "half_gap", p.unit = "m";
    p.effect = effect, p.nominal = nominal, p.lower = lower, p.upper = upper, p.shape = shape;
    fit.parameters = {p};
    fit.value = {value};
    fit.std_deviation = {1};
    fit.blocks = 9;
    fit.covariance = Eigen::MatrixXd::Zero(1, 1);
  }
  Estimated told(std::size_t given) const { return estimate_of(fit, 0, given); }
};

TEST(Estimates, AreStudentsIntervalsAboutTheValue) {
  const OneNumber n(10, 0, -100, 100, 0, false);
  const Estimated e = n.told(0);
  EXPECT_EQ(e.name, "half_gap");
  EXPECT_EQ(e.unit, "m");
  EXPECT_EQ(e.value, 10);
  EXPECT_DOUBLE_EQ(e.lower, 10 - n.half);
  EXPECT_DOUBLE_EQ(e.upper, 10 + n.half);
}

/// x + b is measured exactly. The fit takes b as normal with half its tolerance; b lies anywhere within it.
TEST(Estimates, CountThatANumberOfTheModelLiesAnywhereWithinItsTolerance) {
  constexpr double kTolerance = 0.6, kPrior = kTolerance / 2;
  OneNumber n(10, 0, -100, 100, 0, false);
  FitParameter number;
  number.scale = kPrior;
  n.fit.parameters.push_back(number);
  n.fit.value = {10, 0};
  n.fit.std_deviation = {kPrior, kPrior};
  n.fit.covariance = kPrior * kPrior * Eigen::Matrix2d{{1, -1}, {-1, 1}};
  EXPECT_DOUBLE_EQ(n.told(0).upper, 10 + n.half * kTolerance / std::sqrt(3));
}

TEST(Estimates, EndWhereTheNumberCannotGo) {
  const Estimated e = OneNumber(10, 0, 9.5, 10.25, 0, false).told(0);
  EXPECT_EQ(e.lower, 9.5);
  EXPECT_EQ(e.upper, 10.25);
}

TEST(Estimates, OfASizeThatWasFoundDoNotReachBeyondItsNeutralValue) {
  EXPECT_EQ(OneNumber(1, 0, -100, 100, 0, false).told(0).lower, 0);
  EXPECT_EQ(OneNumber(-1, 0, -100, 100, 0, false).told(0).upper, 0);
  // On its own side the interval is whole.
  const OneNumber above(1, 0, -100, 100, 0, false), below(-1, 0, -100, 100, 0, false);
  EXPECT_DOUBLE_EQ(above.told(0).upper, 1 + above.half);
  EXPECT_DOUBLE_EQ(below.told(0).lower, -1 - below.half);
}

TEST(Estimates, OfShapesGivenEffectsAndNumbersOfTheModelReachBeyondIt) {
  const OneNumber shape(1, 0, -100, 100, 0, true), given(1, 0, -100, 100, 0, false),
      number(1, 0, -100, 100, std::nullopt, false);
  EXPECT_DOUBLE_EQ(shape.told(0).lower, 1 - shape.half);
  EXPECT_DOUBLE_EQ(given.told(1).lower, 1 - given.half);
  EXPECT_DOUBLE_EQ(number.told(0).lower, 1 - number.half);
}

}  // namespace
}  // namespace halyard

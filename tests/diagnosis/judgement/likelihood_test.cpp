/// Gains in log-likelihood, and the part that two candidates share, in closed form.

#include "diagnosis/judgement/likelihood.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_evidence.h"

namespace halyard {
namespace {

const Evidence& two_joints() {
  static const Evidence evidence = small_evidence();
  return evidence;
}

/// A score of which every deciding row has this mean square.
Score score_with(double mean_square) {
  Score s;
  for (const auto& block : two_joints().block_count()) {
    s.block_sum.emplace_back();
    for (const int rows : block) s.block_sum.back().push_back(mean_square * rows);
  }
  return s;
}

TEST(Likelihood, OfABlockIsMinusHalfTheLogarithmForEachIndependentSample) {
  const double m = two_joints().correlated_rows(1);
  EXPECT_NEAR(block_log_likelihood(two_joints(), 1, 30 * m, std::exp(2.0), 0), -30, 1e-12);
  EXPECT_NEAR(block_log_likelihood(two_joints(), 1, 30 * m, 0, std::exp(-2.0)), 30, 1e-12);
  EXPECT_NEAR(block_log_likelihood(two_joints(), 1, 30 * m, 3, 1), -15 * std::log(4.0), 1e-12);
}

TEST(Likelihood, IsOfTheBlocksThatHaveRowsOfAChannel) {
  const std::vector<double> none(4, 0.0);
  Score s = score_with(std::exp(2.0));
  const Likelihood ln = log_likelihood(two_joints(), s, none);
  const auto& count = two_joints().block_count();
  ASSERT_EQ(ln.size(), count.size());
  double sum = 0;
  for (std::size_t b = 0; b < ln.size(); ++b)
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_NEAR(ln[b][c], -count[b][c] / two_joints().correlated_rows(static_cast<int>(c)), 1e-9);
      sum += ln[b][c];
    }
  EXPECT_NEAR(sum, -independent_samples(two_joints()), 1e-9 * std::abs(sum));
}

TEST(Likelihood, AResidualThatIsHalvedEverywhereGainsLn2OfEachIndependentSample) {
  constexpr double kFarAboveTheFloors = 1e6;
  const double gain =
      log_likelihood_gain(two_joints(), score_with(kFarAboveTheFloors), score_with(4 * kFarAboveTheFloors));
  const double independent = independent_samples(two_joints());
  EXPECT_NEAR(gain, independent * std::log(2.0), 1e-6 * gain);
  EXPECT_NEAR(log_likelihood_gain(two_joints(), score_with(4 * kFarAboveTheFloors), score_with(kFarAboveTheFloors)),
              -gain, 1e-9 * gain);
}

TEST(Likelihood, BelowTheFloorsNothingIsGained) {
  const std::vector<double> floors = squared_floors(two_joints());
  ASSERT_EQ(floors.size(), 4u);
  for (std::size_t c = 0; c < 4; ++c) EXPECT_DOUBLE_EQ(floors[c], std::pow(two_joints().floor()[c], 2));
  const double least = *std::ranges::min_element(floors), independent = independent_samples(two_joints());
  EXPECT_LT(log_likelihood_gain(two_joints(), score_with(0), score_with(1e-4 * least)), 1e-4 * independent);
}

TEST(SharedGain, IsTheCommonPartOfTheSmallerGain) {
  const Likelihood none = {{0, 0}, {0, 0}};
  EXPECT_DOUBLE_EQ(shared_gain({{4, 0}, {0, 2}}, {{4, 0}, {0, 2}}, none), 1);
  EXPECT_DOUBLE_EQ(shared_gain({{4, 0}, {0, 0}}, {{0, 0}, {0, 5}}, none), 0) << "other blocks and channels";
  EXPECT_DOUBLE_EQ(shared_gain({{4, 0}, {0, 2}}, {{1, 3}, {0, 0}}, none), 0.25);
  EXPECT_DOUBLE_EQ(shared_gain({{1, 3}, {0, 0}}, {{4, 0}, {0, 2}}, none), 0.25) << "whichever is named first";
  // A loss is no gain, and what all have from the start counts for none.
  EXPECT_DOUBLE_EQ(shared_gain({{4, -9}, {0, 0}}, {{2, -9}, {0, 0}}, none), 1);
  EXPECT_DOUBLE_EQ(shared_gain({{14, 7}, {0, 0}}, {{12, 7}, {0, 0}}, {{10, 7}, {0, 0}}), 1);
  EXPECT_EQ(shared_gain(none, none, none), 0);
}

}  // namespace
}  // namespace halyard

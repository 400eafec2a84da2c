#include "evaluation/sweep/sweep_design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "evaluation/sweep/sweep_summary.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

/// The intervals of length 1 / n that have a sample.
std::set<int> occupied(const std::vector<double>& axis, std::size_t n) {
  std::set<int> intervals;
  for (const double x : axis) intervals.insert(int(std::floor(x * double(n))));
  return intervals;
}

TEST(SweepDesign, ALatinHypercubeHasOneSampleInEachIntervalOfEachAxis) {
  const UnitSamples samples = latin_hypercube(3, 50, 7);
  ASSERT_EQ(samples.size(), 3u);
  for (const std::vector<double>& axis : samples) {
    ASSERT_EQ(axis.size(), 50u);
    const std::set<int> intervals = occupied(axis, 50);
    EXPECT_EQ(intervals.size(), 50u);
    EXPECT_EQ(*intervals.begin(), 0);
    EXPECT_EQ(*intervals.rbegin(), 49);
    EXPECT_FALSE(std::ranges::is_sorted(axis));
  }
  EXPECT_NE(samples[0], samples[1]);
  EXPECT_EQ(latin_hypercube(3, 50, 7), samples) << "the same seed";
  EXPECT_NE(latin_hypercube(3, 50, 8), samples) << "another seed";
}

// A (t, m, s)-net: with the origin, which is left out, the first 2^k points have one in each interval.
TEST(SweepDesign, SobolsSequenceIsEvenOnEachAxisAndInThePlane) {
  const UnitSamples samples = sobol_sequence(2, 63);
  for (const std::vector<double>& axis : samples) EXPECT_EQ(occupied(axis, 64).size(), 63u);
  std::set<std::pair<int, int>> squares;
  for (std::size_t i = 0; i < 63; ++i) squares.insert({int(samples[0][i] * 8), int(samples[1][i] * 8)});
  EXPECT_EQ(squares.size(), 63u) << "of 8 x 8";
}

// By hand: mean 3, s² = (4 + 1 + 0 + 1 + 4) / 4 = 2.5, t(0.975, 4) = 2.776445.
TEST(MeanWithInterval, IsThatOfStudent) {
  MeanWithInterval mean;
  EXPECT_TRUE(std::isnan(mean.mean()));
  for (const double x : {1.0, 2.0, kNan, 3.0, 4.0, 5.0}) mean.add(x);
  EXPECT_EQ(mean.count(), 5u);
  EXPECT_DOUBLE_EQ(mean.mean(), 3);
  // The table's number has seven digits.
  EXPECT_NEAR(mean.half_width(), 2.776445 * std::sqrt(2.5 / 5), 1e-6);
}

}  // namespace
}  // namespace halyard

/// Quantiles, slopes and correlations in closed form, and what wrong samples do to them.

#include "diagnosis/log_check/robust.h"
#include "model/statistics/quantile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace halyard {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// 0 to n - 1, in another order.
std::vector<double> shuffled_integers(int n) {
  std::vector<double> x;
  for (int i = 0; i < n; ++i) x.push_back((i * 37) % n);
  return x;
}

TEST(Robust, QuantilesOfEvenlySpreadNumbersAreTheirShares) {
  std::vector<double> x = shuffled_integers(101);
  for (const double share : {0.0, 0.01, 0.25, 0.5, 0.99, 1.0}) EXPECT_EQ(quantile(x, share), 100 * share) << share;
  EXPECT_EQ(quantile(x, 0.503), 50);  // the nearest
  EXPECT_EQ(quantile(x, 0.507), 51);
  EXPECT_EQ(median(x), 50);
  EXPECT_EQ(spread(x), 98);
  for (int i = 0; i < 50; ++i) x.insert(x.begin() + 2 * i, kMissing);
  EXPECT_EQ(median(x), 50);
  EXPECT_EQ(spread(x), 98);
  EXPECT_TRUE(std::isnan(quantile({kMissing}, 0.5)));
  EXPECT_EQ(spread({}), 0);
}

TEST(Robust, FinitePairsAreThoseOfBothUpToTheShorter) {
  const FinitePairs pairs = finite_pairs({1, kMissing, 3, 4, 5}, {10, 20, kMissing, 40});
  EXPECT_EQ(pairs.x, (std::vector<double>{1, 4}));
  EXPECT_EQ(pairs.y, (std::vector<double>{10, 40}));
}

/// An expected motion, and a reading of -2.5 times as much with another zero.
struct Motion {
  std::vector<double> expected, reading;
  Motion() {
    for (int i = 0; i < 400; ++i) {
      expected.push_back(std::sin(0.05 * i) + 0.3 * std::sin(0.13 * i));
      reading.push_back(7 - 2.5 * expected.back());
    }
  }
};

TEST(Robust, TheSlopeOfAStraightLineExplainsAll) {
  const Motion m;
  for (const std::size_t change : {1, 20}) {
    const Slope s = slope_of(m.reading, m.expected, change);
    // Changes of 1e-4 and more of numbers of 10.
    EXPECT_NEAR(s.slope, -2.5, 1e-9);
    EXPECT_NEAR(s.explained, 1, 1e-9);
  }
}

TEST(Robust, WrongSamplesDoNotChangeASlopeAndWeighByTheirChange) {
  Motion m;
  for (int i = 50; i < 400; i += 50) m.reading[i] += 100;
  for (int i = 20; i < 400; i += 60) m.reading[i] = kMissing;
  EXPECT_NEAR(slope_of(m.reading, m.expected, 10).slope, -2.5, 1e-9);
  EXPECT_LT(slope_of(m.reading, m.expected, 10).explained, 0.5);  // 14 changes of 100 beside those of the motion
}

TEST(Robust, ASlopeIsTheMedianThatIsWeightedByWhatIsExpected) {
  // Changes: 3 of slope 1 and size 1, one of slope 5 and size 4: more than half of the expected motion.
  const std::vector<double> expected = {0, 1, 2, 3, 7}, reading = {0, 1, 2, 3, 23};
  const Slope s = slope_of(reading, expected, 1);
  EXPECT_EQ(s.slope, 5);
  EXPECT_DOUBLE_EQ(s.explained, 1 - 3 * 4.0 / 23);
}

TEST(Robust, WithoutMotionThereIsNoSlope) {
  const std::vector<double> still(10, 3.0), moving = shuffled_integers(10);
  for (const auto& [reading, expected] : {std::pair(moving, still), std::pair(still, moving)}) {
    const Slope s = slope_of(reading, expected, 1);
    EXPECT_EQ(s.slope, 0);
    EXPECT_EQ(s.explained, 0);
  }
  EXPECT_EQ(slope_of(moving, moving, 10).explained, 0) << "shorter than a change";
}

TEST(Robust, TheCorrelationOfSinesIsTheCosineOfTheirPhase) {
  for (const double phase : {0.0, 1.0, 2.5}) {
    std::vector<double> x, y;
    for (int i = 0; i < 5000; ++i) {
      x.push_back(3 + 2 * std::sin(2 * std::numbers::pi * i / 250));
      y.push_back(-1 + 5 * std::sin(2 * std::numbers::pi * i / 250 + phase));
    }
    const Correlation c = correlation_of(x, y);
    EXPECT_EQ(c.n, 5000u);
    // Tops beyond the central 98 % are cut: 5e-4 of a sine's amplitude.
    EXPECT_NEAR(c.r, std::cos(phase), 1e-3);
    EXPECT_NEAR(c.size, 2.5, 2.5e-3);
    x[100] = 1e6;
    y[200] = -1e6;
    y[300] = kMissing;
    EXPECT_EQ(correlation_of(x, y).n, 4999u);
    EXPECT_NEAR(correlation_of(x, y).r, std::cos(phase), 5e-3) << "wrong samples are cut, too";
  }
}

TEST(Robust, OfFewSamplesOrAConstantThereIsNoCorrelation) {
  EXPECT_EQ(correlation_of({1, 2}, {1, 2}).r, 0);
  EXPECT_EQ(correlation_of({1, 2}, {1, 2}).n, 2u);
  EXPECT_NEAR(correlation_of({1, 2, 3}, {1, 2, 3}).r, 1, 1e-15);
  EXPECT_EQ(correlation_of({1, 1, 1, 1}, {1, 2, 3, 4}).r, 0);
  EXPECT_EQ(correlation_of({1, 2, 3, 4}, {1, 1, 1, 1}).r, 0);
}

}  // namespace
}  // namespace halyard

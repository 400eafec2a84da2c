/// The paired t test against closed forms and its own promise.

#include "diagnosis/judgement/paired_t.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/limits.h"

namespace halyard {
namespace {

TEST(PairedT, IsMeanOverItsStandardError) {
  const Paired p = paired({1, 2, 3});
  EXPECT_EQ(p.pairs, 3);
  EXPECT_DOUBLE_EQ(p.sum, 6);
  EXPECT_DOUBLE_EQ(p.t, 2 * std::sqrt(3.0));  // mean 2, deviation 1
  EXPECT_DOUBLE_EQ(paired({-1, -2, -3}).t, -p.t);
}

TEST(PairedT, HasTheTailOfStudentsDistribution) {
  // With two degrees of freedom P(T > t) = (1 - t / √(2 + t²)) / 2.
  for (const double t : {-3.0, 0.0, 0.5, 4.0})
    EXPECT_NEAR(p_value({.sum = 1, .t = t, .pairs = 3}), 0.5 * (1 - t / std::sqrt(2 + t * t)), 10 * kEps) << t;
  // With many, the normal distribution's, up to terms of 1 / N.
  EXPECT_NEAR(p_value({.sum = 1, .t = 1.96, .pairs = 100000}), 0.5 * std::erfc(1.96 / std::sqrt(2.0)), 1e-5);
}

TEST(PairedT, SaysNothingOfTooFewPairsOrOfOnesThatDoNotScatter) {
  EXPECT_EQ(p_value(paired({})), 1);
  EXPECT_EQ(p_value(paired({5, 6})), 1);
  EXPECT_EQ(paired({}).t, 0);
  EXPECT_EQ(paired({2, 2, 2}).t, 0);
}

TEST(PairedT, RejectsATrueNullAsOftenAsItSays) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  constexpr int kTrials = 4000;
  int rejected = 0;
  for (int i = 0; i < kTrials; ++i) {
    std::vector<double> differences(8);
    for (double& d : differences) d = normal(random);
    rejected += p_value(paired(differences)) < 0.05;
  }
  // Four standard deviations of a binomial count.
  EXPECT_NEAR(rejected, 0.05 * kTrials, 4 * std::sqrt(kTrials * 0.05 * 0.95));
}

}  // namespace
}  // namespace halyard

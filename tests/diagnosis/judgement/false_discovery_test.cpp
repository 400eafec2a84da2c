#include "diagnosis/judgement/false_discovery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace halyard {
namespace {

TEST(FalseDiscovery, OfTheFifteenTestsOfBenjaminiAndHochberg) {
  // Their section 3.1: at 5 % four are rejected, where Bonferroni's bound of 0.0033 leaves three.
  const std::vector<double> p = {0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                                 0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000};
  const std::vector<double> rate = false_discovery_rates(p);
  EXPECT_EQ(std::ranges::count_if(rate, [](double r) { return r < 0.05; }), 4);
  EXPECT_DOUBLE_EQ(rate[0], 15 * 0.0001);
  EXPECT_DOUBLE_EQ(rate[3], 15 * 0.0095 / 4);
  EXPECT_DOUBLE_EQ(rate[14], 1);
}

TEST(FalseDiscovery, KeepsTheOrderOfItsTests) {
  const std::vector<double> rate = false_discovery_rates({0.5, 0.001, 0.02});
  EXPECT_DOUBLE_EQ(rate[0], 0.5);
  EXPECT_DOUBLE_EQ(rate[1], 0.003);
  EXPECT_DOUBLE_EQ(rate[2], 0.03);
  EXPECT_TRUE(false_discovery_rates({}).empty());
}

TEST(FalseDiscovery, WhereNothingIsTrueFewRoundsFindAnything) {
  // Sixteen tests of one residual, correlated as candidates are: at 5 % at most one round in twenty has a rejection.
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  constexpr int kRounds = 4000;
  int found = 0;
  for (int round = 0; round < kRounds; ++round) {
    const double shared = normal(random);
    std::vector<double> p(16);
    for (double& x : p) x = 0.5 * std::erfc((0.8 * shared + 0.6 * normal(random)) / std::sqrt(2.0));
    found += std::ranges::min(false_discovery_rates(p)) < 0.05;
  }
  EXPECT_LT(found, 0.05 * kRounds);
  EXPECT_GT(found, 0.01 * kRounds);
}

}  // namespace
}  // namespace halyard

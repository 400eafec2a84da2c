#include "diagnosis/judgement/name_probability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "diagnosis/judgement/decision_rule.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/small_evidence.h"

namespace {

using halyard::Competitor;
using halyard::kRule;
using halyard::Likelihood;

/// So many nats in every deciding block that has rows.
Likelihood even_gain(const halyard::Evidence& evidence, double nats) {
  Likelihood ln;
  for (const auto& count : evidence.block_count()) ln.emplace_back(count.size(), 0.0), ln.back()[0] = nats;
  return ln;
}

TEST(NameWeights, OfEqualCandidatesAreEqualAndSumToOneWithNoEffect) {
  const halyard::Evidence evidence = halyard::small_evidence();
  const Likelihood gain = even_gain(evidence, 3), none = even_gain(evidence, 0);
  const std::vector<double> w = halyard::name_weights(evidence, {{&gain, 1}, {&gain, 1}}, {&none, 0});
  ASSERT_EQ(w.size(), 3U);
  EXPECT_DOUBLE_EQ(w[0], w[1]);
  EXPECT_NEAR(w[0] + w[1] + w[2], 1, 1e-12);
  EXPECT_LT(w[2], 1e-3);
}

TEST(NameWeights, FallByTheFactorOfThePriorCost) {
  const halyard::Evidence evidence = halyard::small_evidence();
  const Likelihood gain = even_gain(evidence, 3), none = even_gain(evidence, 0);
  const std::vector<double> w = halyard::name_weights(evidence, {{&gain, 1}, {&gain, 2.5}}, {&none, 0});
  EXPECT_NEAR(w[0] / w[1], std::exp(1.5), 1e-9);
}

TEST(NameWeights, AGainOfOneBlockAloneIsDoubtful) {
  const halyard::Evidence evidence = halyard::small_evidence();
  const Likelihood none = even_gain(evidence, 0);
  Likelihood one = none;
  one.back()[0] = 5;
  const std::vector<double> w = halyard::name_weights(evidence, {{&one, 1}}, {&none, 0});
  EXPECT_GT(w[1], 0.05) << "another log may not contain that block";
}

TEST(ProbabilityOfNone, IsAHalfAtTheRestThatMatters) {
  const double floor = 2e-4, rest = kRule.rest_ratio * floor;
  EXPECT_NEAR(halyard::probability_of_none(rest * rest, 0, floor), 0.5, 1e-12);
  EXPECT_LT(halyard::probability_of_none(floor * floor, 0, floor), 0.05);
  EXPECT_GT(halyard::probability_of_none(100 * rest * rest, 0, floor), 0.99);
}

TEST(ProbabilityOfNone, IsSmallIfTheRestIsThatOfAnotherForm) {
  const double misfit = 0.5;
  EXPECT_LT(halyard::probability_of_none(0.25 * misfit * misfit, misfit * misfit, 1e-6), 0.05);
}

TEST(ProbabilityOfClean, CountsTheAlternativesOfAName) {
  EXPECT_NEAR(halyard::probability_of_clean(0, 0.9, {0.6 + 0.4}), 0, 1e-12) << "one of both acts";
  EXPECT_NEAR(halyard::probability_of_clean(0, 0.9, {0.6 + 0.1, 0.8}), 0.2, 1e-12) << "the surest effect decides";
  EXPECT_NEAR(halyard::probability_of_clean(0.1, 0.9, {}), 0.81, 1e-12);
}

TEST(CredibleSet, IsTheSmallestOneWithItsShare) {
  EXPECT_EQ(halyard::credible_set({0.5, 0.1, 0.4}, 0.9), (std::vector<bool>{true, false, true}));
  EXPECT_EQ(halyard::credible_set({0.95, 0.05}, 0.9), (std::vector<bool>{true, false}));
}

TEST(NameWeights, OfAGainThatIsEvenOverTheBlocksThatHaveRowsAreThoseOfItsSum) {
  const auto& count = halyard::made_evidence().block_count();
  const auto has_rows = [&](std::size_t b) { return std::reduce(count[b].begin(), count[b].end()) > 0; };
  Likelihood gain = even_gain(halyard::made_evidence(), 0);
  const Likelihood none = gain;
  double blocks = 0;
  for (std::size_t b = 0; b < count.size(); ++b) blocks += has_rows(b);
  ASSERT_LT(blocks, static_cast<double>(count.size())) << "the first half second is not compared";
  for (std::size_t b = 0; b < count.size(); ++b)
    if (has_rows(b)) gain[b][0] = std::log(3.0) / blocks;
  const std::vector<double> w = halyard::name_weights(halyard::made_evidence(), {{&gain, 0}}, {&none, 0});
  // Whatever the weights of the blocks are in a draw, their sum is the number of blocks.
  EXPECT_NEAR(w[0], 0.75, 1e-12);
  EXPECT_NEAR(w[1], 0.25, 1e-12);
}

TEST(ProbabilityOfNone, CountsTheMisfitAsPartOfTheFloor) {
  // Sixteen squared floors beside a misfit of three are four, where nine make it even: 1 / (1 + (9 / 4)^1.5).
  const double floor = 1e-3, square = floor * floor;
  EXPECT_NEAR(halyard::probability_of_none(16 * square, 3 * square, floor), 8.0 / 35, 1e-12);
  EXPECT_EQ(halyard::probability_of_none(0, 0, floor), 0);
}

}  // namespace

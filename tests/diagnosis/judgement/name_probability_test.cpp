#include "diagnosis/judgement/name_probability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/judgement/decision_rule.h"
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

}  // namespace

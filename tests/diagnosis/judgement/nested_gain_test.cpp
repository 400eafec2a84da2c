#include "diagnosis/judgement/nested_gain.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "diagnosis/judgement/likelihood.h"
#include "diagnosis/judgement/paired_t.h"
#include "tests/support/small_evidence.h"

namespace halyard {
namespace {

Score score_of(const Evidence& evidence, std::vector<double> residuals) {
  Score s;
  s.block_sum = evidence.block_products(residuals, residuals);
  s.deciding = std::move(residuals);
  return s;
}

std::size_t deciding_rows(const Evidence& evidence) {
  int rows = 0;
  for (const auto& block : evidence.block_count()) rows += std::reduce(block.begin(), block.end());
  return static_cast<std::size_t>(rows);
}

std::vector<double> noise(std::size_t n, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::vector<double> x(n);
  for (double& v : x) v = normal(random);
  return x;
}

TEST(NestedGain, OfAnEffectThatExplainsAllIsTheNumberOfIndependentSamples) {
  const Evidence evidence = small_evidence();
  const std::vector<double> none(4, 0.0), residual(deciding_rows(evidence), 0.3);
  const std::vector<double> gains = nested_gains(
      evidence, score_of(evidence, std::vector<double>(residual.size(), 0.0)), score_of(evidence, residual), none);
  double sum = 0;
  for (const double g : gains) sum += g;
  EXPECT_NEAR(sum, independent_samples(evidence), 1e-9 * sum);
}

/// An effect of which a third of the fitted size is true makes the residual larger, and yet it is there.
TEST(NestedGain, FindsAnEffectThatTheFitHasMadeTooLarge) {
  const Evidence evidence = small_evidence();
  std::mt19937 random(1);
  const std::size_t n = deciding_rows(evidence);
  const std::vector<double> shape = noise(n, random), rest = noise(n, random), none(4, 0.0);
  std::vector<double> without(n), with(n);
  for (std::size_t r = 0; r < n; ++r) without[r] = rest[r] + shape[r], with[r] = without[r] - 3 * shape[r];
  const Score before = score_of(evidence, without), after = score_of(evidence, with);
  EXPECT_LT(paired(evidence, log_likelihood(evidence, after, squared_floors(evidence)),
                   log_likelihood(evidence, before, squared_floors(evidence)))
                .sum,
            0);
  EXPECT_LT(p_value(paired(nested_gains(evidence, after, before, none))), 1e-3);
}

TEST(NestedGain, RejectsATrueNullAsOftenAsItSays) {
  const Evidence evidence = small_evidence();
  std::mt19937 random(2);
  const std::size_t n = deciding_rows(evidence);
  constexpr int kTrials = 2000;
  int rejected = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<double> without = noise(n, random);
    std::vector<double> with = noise(n, random);
    for (std::size_t r = 0; r < n; ++r) with[r] = without[r] - 0.5 * with[r];
    const auto gains =
        nested_gains(evidence, score_of(evidence, with), score_of(evidence, without), std::vector<double>(4, 0.0));
    rejected += p_value(paired(gains)) < 0.05;
  }
  // 100 ± 10 expected; four standard deviations.
  EXPECT_NEAR(rejected, 0.05 * kTrials, 40);
}

TEST(NestedGain, IsTwoThirdsOfItWhereTheFloorIsAsLargeAsTheResidual) {
  const Evidence evidence = brief_evidence();
  const std::vector<double> residual(deciding_rows(evidence), 0.3), zero(residual.size(), 0.0), floor(2, 0.3 * 0.3);
  const std::vector<double> gains =
      nested_gains(evidence, score_of(evidence, zero), score_of(evidence, residual), floor);
  const double independent = independent_samples(evidence);
  EXPECT_NEAR(std::reduce(gains.begin(), gains.end()), independent * 2 / 3, 1e-9 * independent);
}

}  // namespace
}  // namespace halyard

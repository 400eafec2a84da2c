#include "diagnosis/fit/block_variance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace {

constexpr double kRho = 0.9;

/// First-order autoregressive noise of unit variance.
Eigen::VectorXd correlated_noise(int n, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd x(n);
  x(0) = normal(random);
  for (int i = 1; i < n; ++i) x(i) = kRho * x(i - 1) + std::sqrt(1 - kRho * kRho) * normal(random);
  return x;
}

TEST(BlockVariance, IsThatOfTheMeanOfCorrelatedNoise) {
  // The variance of the mean is (1 + ρ) / (1 - ρ) / n; that of independent samples would be 19 times smaller.
  const int n = 4000, length = 100, draws = 50;
  std::mt19937 random(1);
  std::vector<int> block(n);
  for (int i = 0; i < n; ++i) block[i] = i / length;
  double mean = 0;
  for (int d = 0; d < draws; ++d) {
    Eigen::VectorXd r = correlated_noise(n, random);
    r.array() -= r.mean();
    const halyard::BlockVariance v =
        halyard::block_variance(Eigen::MatrixXd::Ones(n, 1), r, Eigen::VectorXd::Zero(1), block);
    EXPECT_EQ(v.blocks, n / length);
    mean += v.covariance(0, 0) / draws;
  }
  const double expected = (1 + kRho) / (1 - kRho) / n;
  // Blocks of five correlation times miss a tenth of it; the mean of 50 draws of χ²(39) scatters by 3 %.
  EXPECT_NEAR(mean, expected, 0.2 * expected);
}

TEST(BlockVariance, IsThePriorsWithoutData) {
  const std::vector<int> block(10, 0);
  const halyard::BlockVariance v = halyard::block_variance(Eigen::MatrixXd::Zero(10, 1), Eigen::VectorXd::Ones(10),
                                                           Eigen::VectorXd::Constant(1, 4), block);
  EXPECT_NEAR(v.covariance(0, 0), 0.25, 1e-9);
}

TEST(BlockVariance, CorrelationTimeIsThatOfTheProcess) {
  std::mt19937 random(2);
  double mean = 0;
  const int draws = 20;
  for (int d = 0; d < draws; ++d) {
    const Eigen::VectorXd x = correlated_noise(20000, random);
    mean += halyard::correlation_rows({x.data(), static_cast<std::size_t>(x.size())}) / draws;
  }
  // 1 + 2 Σ ρ^l up to ρ^l = 0.1: nine tenths of (1 + ρ) / (1 - ρ) = 19.
  EXPECT_NEAR(mean, 17.2, 1.0);
}

TEST(BlockVariance, BlocksAreGroupedButSomeAreLeft) {
  std::vector<int> block(100);
  std::iota(block.begin(), block.end(), 0);
  EXPECT_EQ(halyard::grouped_blocks(block, 4, 10).back(), 24);
  EXPECT_EQ(halyard::grouped_blocks(block, 50, 10).back(), 9);
}

TEST(BlockVariance, CorrelationTimeDoesNotDependOnTheMean) {
  std::mt19937 random(3);
  const auto rows_of = [](const Eigen::VectorXd& x) {
    return halyard::correlation_rows({x.data(), static_cast<std::size_t>(x.size())});
  };
  const Eigen::VectorXd x = correlated_noise(2000, random), above = x.array() + 50;
  // Products of 50 keep 12 digits.
  EXPECT_NEAR(rows_of(above), rows_of(x), 1e-8 * rows_of(x));
}

TEST(BlockVariance, OfTwoBlocksIsTwiceTheirScatterAndThePriorBetweenTheInverses) {
  // g = ±3, Σ g² = 18, B / (B - 1) = 2, P = 4, H = 4 + 4: C = (36 + 4) / 64.
  const Eigen::Vector4d r(1, 2, -1, -2);
  const std::vector<int> block = {5, 5, 9, 9};
  const halyard::BlockVariance v =
      halyard::block_variance(Eigen::MatrixXd::Ones(4, 1), r, Eigen::VectorXd::Constant(1, 4), block);
  EXPECT_EQ(v.blocks, 2);
  EXPECT_NEAR(v.covariance(0, 0), 40.0 / 64, 1e-9);
}

TEST(BlockVariance, CorrelationTimeOfAStepEndsAtAQuarterOfTheRows) {
  // Of 20 rows of 1 and 20 of -1, ρ at lag l is 1 - 3 l / 40. Lags 1 to 9 count.
  std::vector<double> step(40, 1.0);
  for (std::size_t i = 20; i < step.size(); ++i) step[i] = -1;
  EXPECT_NEAR(halyard::correlation_rows(step), 1 + 2 * (9 - 3 * 45 / 40.0), 1e-12);
}

TEST(BlockVariance, BlocksAreGroupedFromTheFirstOn) {
  std::vector<int> block(100);
  std::iota(block.begin(), block.end(), 300);
  const std::vector<int> groups = halyard::grouped_blocks(block, 50, 10);
  EXPECT_EQ(groups.front(), 0);
  EXPECT_EQ(groups[10], 1);
  EXPECT_EQ(groups.back(), 9);
}

}  // namespace

/// Least squares over blocks: the step by closed forms, the interval by how often it holds.

#include "estimators/identification/block_jackknife.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace halyard {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::VectorXd unbounded(Eigen::Index p) { return Eigen::VectorXd::Constant(p, kInfinity); }

std::vector<BlockSums> two_numbers() {
  std::vector<BlockSums> blocks(3);
  for (int b = 0; b < 3; ++b) {
    blocks[b].A = (Eigen::Matrix2d() << 4 + b, 1, 1, 3).finished();
    blocks[b].g = Eigen::Vector2d(5 - b, 2 + b);
  }
  return blocks;
}

TEST(BlockJackknife, StepsToTheLeastSquaresFromAnyStart) {
  const std::vector<BlockSums> blocks = two_numbers();
  for (const Eigen::Vector2d& u : {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.5, -1)}) {
    Eigen::Matrix2d A = Eigen::Matrix2d::Identity();
    Eigen::Vector2d g = -u;
    for (const BlockSums& b : blocks) A += b.A, g += b.g;
    const JackknifeEstimate e = jackknife_least_squares(blocks, u, unbounded(2));
    EXPECT_LT((A * (e.u - u) - g).norm(), 1e-14 * g.norm());  // a few roundings
    EXPECT_EQ(e.blocks, 3);
  }
}

TEST(BlockJackknife, IsTheClassicJackknifeOfAMeanWhereThePriorIsWeak) {
  // One number, blocks alike in information: u is the mean of g_b / a, and the jackknife's deviation is the standard
  // error of that mean.
  constexpr double a = 1e8;
  const std::vector<double> mean_of_block = {0.3, 0.1, 0.4, 0.1, 0.5};
  std::vector<BlockSums> blocks;
  double mean = 0, square = 0;
  for (const double m : mean_of_block) {
    blocks.push_back({Eigen::MatrixXd::Constant(1, 1, a), Eigen::VectorXd::Constant(1, a * m)});
    mean += m / 5;
  }
  for (const double m : mean_of_block) square += (m - mean) * (m - mean);
  const JackknifeEstimate e = jackknife_least_squares(blocks, Eigen::VectorXd::Zero(1), unbounded(1));
  // The prior is 1 of 5e8.
  EXPECT_NEAR(e.u(0), mean, 1e-8);
  EXPECT_NEAR(e.deviation(0), std::sqrt(square / (5 * 4)), 1e-8);
}

TEST(BlockJackknife, ThePriorsOwnUncertaintyAddsToThatOfTheBlocks) {
  // A = 1 + 1 + 1. Without the first block u is -10 / 2, without the second 10 / 2: a variance of 1/2 (25 + 25).
  const std::vector<BlockSums> blocks = {{Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Constant(1, 10)},
                                         {Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Constant(1, -10)}};
  const JackknifeEstimate e = jackknife_least_squares(blocks, Eigen::VectorXd::Zero(1), unbounded(1));
  EXPECT_DOUBLE_EQ(e.deviation(0), std::sqrt(25 + 1.0 / 9));
}

TEST(BlockJackknife, NeverSaysLessThanTheInformationAllows) {
  // Blocks that agree exactly.
  const std::vector<BlockSums> blocks(6, {Eigen::MatrixXd::Constant(1, 1, 4.0), Eigen::VectorXd::Constant(1, 2.0)});
  const JackknifeEstimate e = jackknife_least_squares(blocks, Eigen::VectorXd::Zero(1), unbounded(1));
  EXPECT_NEAR(e.deviation(0), 1 / std::sqrt(6 * 4.0 + 1), 0.02);
  EXPECT_GE(e.deviation(0), 1 / std::sqrt(6 * 4.0 + 1));
}

TEST(BlockJackknife, HoldsANumberAtItsBoundAndSolvesTheRest) {
  const std::vector<BlockSums> blocks = two_numbers();
  const Eigen::Vector2d bound(0.2, kInfinity);
  const JackknifeEstimate e = jackknife_least_squares(blocks, Eigen::Vector2d::Zero(), bound);
  // The first number is at its bound; the second solves A_22 u_2 = g_2 - A_21 u_1.
  EXPECT_DOUBLE_EQ(e.u(0), 0.2);
  EXPECT_NEAR(e.u(1), (9 - 3 * 0.2) / (9 + 1), 1e-14);
  EXPECT_EQ(e.deviation(0), 0);
  EXPECT_GT(e.deviation(1), 0);
}

TEST(BlockJackknife, HoldsTheTruthWhereResidualsAreAlikeWithinABlock) {
  // Each block's error is three times what its information says, as of a record whose errors last.
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  constexpr int kTrials = 1000, kBlocks = 20;
  constexpr double a = 100, t = 2.093;  // Student's t of 19 at 97.5 %
  int by_jackknife = 0, by_information = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double truth = normal(random);
    std::vector<BlockSums> blocks;
    for (int b = 0; b < kBlocks; ++b)
      blocks.push_back({Eigen::MatrixXd::Constant(1, 1, a),
                        Eigen::VectorXd::Constant(1, a * truth + 3 * std::sqrt(a) * normal(random))});
    const JackknifeEstimate e = jackknife_least_squares(blocks, Eigen::VectorXd::Zero(1), unbounded(1));
    by_jackknife += std::abs(e.u(0) - truth) <= t * e.deviation(0);
    by_information += std::abs(e.u(0) - truth) <= 1.96 / std::sqrt(kBlocks * a + 1);
  }
  // Four standard deviations of a binomial count; an interval of the information alone holds 1.96 / 3 deviations: 49 %.
  EXPECT_NEAR(by_jackknife, 0.95 * kTrials, 4 * std::sqrt(kTrials * 0.95 * 0.05));
  EXPECT_NEAR(by_information, 0.487 * kTrials, 4 * std::sqrt(kTrials * 0.25));
}

TEST(BlockJackknife, TheRestOfANumberAtItsBoundScattersAsItsBlocksDo) {
  std::vector<BlockSums> blocks(2);
  blocks[0].A = (Eigen::Matrix2d() << 4, 2, 2, 3).finished(), blocks[0].g = Eigen::Vector2d(10, 8);
  blocks[1].A = (Eigen::Matrix2d() << 4, -1, -1, 3).finished(), blocks[1].g = Eigen::Vector2d(10, -6);
  const JackknifeEstimate e = jackknife_least_squares(blocks, Eigen::Vector2d::Zero(), Eigen::Vector2d(0.2, kInfinity));
  EXPECT_DOUBLE_EQ(e.u(0), 0.2);
  EXPECT_NEAR(e.u(1), (2 - 0.2) / 7, 1e-14);
  // Without the first block (-6 + 0.2) / 4, without the second (8 - 0.4) / 4; and what the prior leaves.
  EXPECT_NEAR(e.deviation(1), std::sqrt(0.5 * 2 * 1.675 * 1.675 + 1.0 / 49), 1e-13);
  EXPECT_EQ(e.deviation(0), 0);
}

}  // namespace
}  // namespace halyard

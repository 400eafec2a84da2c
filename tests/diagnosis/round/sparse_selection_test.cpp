#include "diagnosis/round/sparse_selection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace halyard {
namespace {

constexpr int kRows = 400;
constexpr double kNoise = 0.1;

/// Column k of an orthogonal family, Σ x² = kRows / 2.
Eigen::VectorXd cosine(int k) {
  Eigen::VectorXd x(kRows);
  for (int i = 0; i < kRows; ++i) x(i) = std::cos(std::numbers::pi * k * (i + 0.5) / kRows);
  return x;
}

Eigen::VectorXd noise(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, kNoise);
  Eigen::VectorXd x(kRows);
  for (double& v : x) v = normal(random);
  return x;
}

/// One channel, one column in each group, no bounds.
SparseProblem problem_of(const std::vector<Eigen::VectorXd>& columns, const Eigen::VectorXd& x) {
  SparseProblem p;
  p.x = x;
  p.columns.resize(kRows, std::ssize(columns));
  for (std::size_t i = 0; i < columns.size(); ++i) p.columns.col(static_cast<Eigen::Index>(i)) = columns[i];
  p.upper = Eigen::VectorXd::Constant(std::ssize(columns), 1e3);
  p.lower = -p.upper;
  p.prior = Eigen::VectorXd::Zero(std::ssize(columns));
  p.channel.assign(kRows, 0);
  p.least_square = {1e-6};
  p.correlated_rows = {1};
  for (std::size_t i = 0; i < columns.size(); ++i)
    p.groups.push_back({static_cast<Eigen::Index>(i), 1, 1, static_cast<int>(i)});
  return p;
}

std::vector<Eigen::VectorXd> cosines(int n) {
  std::vector<Eigen::VectorXd> all;
  for (int k = 1; k <= n; ++k) all.push_back(cosine(k));
  return all;
}

using Groups = std::vector<std::size_t>;

TEST(SparseSelection, FindsTheSetAmongOrthogonalColumnsWithTheAmountsOfTheirProjections) {
  const std::vector<Eigen::VectorXd> columns = cosines(20);
  const Eigen::VectorXd x = 0.3 * columns[2] - 0.2 * columns[7] + 0.1 * columns[15] + noise(1);
  const SelectedGroups s = select_groups(problem_of(columns, x), 6, 4);
  EXPECT_EQ(s.groups, (Groups{2, 7, 15}));
  // The projection, but for the 1e-9 that keeps columns apart.
  for (const int i : {2, 7, 15}) EXPECT_NEAR(s.amount(i), columns[i].dot(x) / columns[i].squaredNorm(), 1e-8);
}

TEST(SparseSelection, FindsTwoColumnsThatHideEachOtherBesideOneThatExplainsMoreAlone) {
  // x = a + b, a and b nearly opposite: alone a explains nothing and b 8 %, the decoy half.
  std::vector<Eigen::VectorXd> columns = cosines(12);
  const Eigen::VectorXd a = columns[0], b = 0.3 * columns[1] - columns[0];
  columns[0] = a, columns[1] = b;
  columns[2] = cosine(2) + cosine(3);
  const Eigen::VectorXd x = a + b + 0.1 * noise(2);
  EXPECT_EQ(select_groups(problem_of(columns, x), 6, 4).groups, (Groups{0, 1}));
  EXPECT_EQ(select_groups(problem_of(columns, x), 1, 4).groups, Groups{2});
}

TEST(SparseSelection, OfNoiseSelectsNothing) {
  // A column has to gain ½ ln 400 + ln 20 = 6 nats, a χ²(1) of 12: 20 columns, 40 draws, 0.4 expected.
  int named = 0;
  for (int draw = 0; draw < 40; ++draw)
    named += !select_groups(problem_of(cosines(20), noise(100 + draw)), 6, 4).groups.empty();
  EXPECT_LE(named, 3);
}

TEST(SparseSelection, KeepsToBoundsAndToOneGroupOfAnOwner) {
  const std::vector<Eigen::VectorXd> columns = cosines(4);
  SparseProblem p = problem_of(columns, 0.3 * columns[0] - 0.2 * columns[1] + noise(3));
  p.groups[1].owner = 0;
  EXPECT_EQ(select_groups(p, 6, 4).groups, Groups{0}) << "the stronger one of its owner";
  p.groups[1].owner = 1;
  p.lower.setZero();
  EXPECT_EQ(select_groups(p, 6, 4).groups, Groups{0}) << "the other would have to be negative";
}

TEST(SparseSelection, DoesNotChooseWhatAColumnThatEverySetMayUseExplains) {
  std::vector<Eigen::VectorXd> columns = cosines(4);
  columns[2] = columns[0];
  SparseProblem p = problem_of(columns, 0.3 * columns[0] + noise(4));
  p.free = 1;
  p.prior(0) = 1;
  p.groups.erase(p.groups.begin());
  EXPECT_TRUE(select_groups(p, 6, 4).groups.empty());
  // As far as its bound reaches.
  p.upper(0) = 0.1;
  EXPECT_EQ(select_groups(p, 6, 4).groups, Groups{1});
}

TEST(SparseSelection, WeighsEachChannelByWhatIsLeftInIt) {
  // A weak column in a quiet channel beside a strong residual, in other units, that nothing explains.
  std::vector<Eigen::VectorXd> columns = cosines(6);
  Eigen::VectorXd x = 0.02 * columns[3] + 0.1 * noise(5);
  SparseProblem p = problem_of(columns, x);
  for (int i = 0; i < kRows; i += 2) p.channel[i] = 1, p.x(i) = 1e3 * std::cos(7.7 * i * i);
  p.columns(Eigen::seq(0, Eigen::last, 2), Eigen::all).setZero();
  p.least_square = {1e-6, 1e-6};
  p.correlated_rows = {1, 1};
  EXPECT_EQ(select_groups(p, 6, 4).groups, Groups{3});
}

TEST(SparseSelection, HoldsAnAmountByItsPrior) {
  // The residual hardly counts beside the least square of 1: ½ Σ (x - a y)² + ½ P a², with Σ y² = P = 200.
  const std::vector<Eigen::VectorXd> columns = cosines(1);
  SparseProblem p = problem_of(columns, 1e-3 * columns[0]);
  p.groups.clear();
  p.free = 1;
  p.prior(0) = kRows / 2;
  p.least_square = {1};
  EXPECT_NEAR(select_groups(p, 6, 4).amount(0), 0.5e-3, 1e-8);
}

TEST(SparseSelection, PaysForNumbersByIndependentSamplesAndForTheChoiceByOwners) {
  const std::vector<Eigen::VectorXd> columns = cosines(3);
  SparseProblem p = problem_of(columns, 10 * columns[0]);
  p.least_square = {1};
  p.correlated_rows = {4};
  p.groups[0].numbers = 3;
  p.groups[1].owner = 0, p.groups[2].owner = 1;
  const SelectedGroups s = select_groups(p, 6, 4);
  EXPECT_EQ(s.groups, Groups{0});
  // Nothing is left, and ln 1 = 0: three numbers at half the logarithm of 100 samples, one of two owners.
  EXPECT_NEAR(s.cost, 1.5 * std::log(kRows / 4.0) + std::log(2.0), 1e-9);
}

}  // namespace
}  // namespace halyard

/// The best permutation against all of them.

#include "diagnosis/log_check/exchanges/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace halyard {
namespace {

constexpr double kImpossible = std::numeric_limits<double>::infinity();

double sum_of(const PlaceCost& cost, const std::vector<int>& p) {
  double sum = 0;
  for (std::size_t k = 1; k <= p.size(); ++k) sum += cost({p.begin(), p.begin() + static_cast<std::ptrdiff_t>(k)});
  return sum;
}

double least_sum(int n, const PlaceCost& cost) {
  std::vector<int> p(n);
  std::iota(p.begin(), p.end(), 0);
  double least = kImpossible;
  do least = std::min(least, sum_of(cost, p));
  while (std::ranges::next_permutation(p).found);
  return least;
}

TEST(BestAssignments, HasTheLeastSumOfAllPermutations) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 1; n <= 6; ++n) {
    std::vector<std::vector<double>> c(n, std::vector<double>(n));
    for (auto& row : c)
      for (double& x : row) x = unit(random) < 0.2 ? kImpossible : unit(random);
    for (int k = 0; k < n; ++k) c[k][k] = 1;  // one is always possible
    // The cost of a place depends on the column before it, too.
    const PlaceCost cost = [&](const std::vector<int>& p) {
      const std::size_t k = p.size() - 1;
      return c[k][p[k]] * (k > 0 && p[k - 1] > p[k] ? 1.5 : 1);
    };
    // The same numbers are added in the same order.
    EXPECT_EQ(sum_of(cost, best_assignments(n, cost, 1).at(0)), least_sum(n, cost)) << n;
  }
}

TEST(BestAssignments, AreInTheOrderOfTheirSums) {
  const PlaceCost cost = [](const std::vector<int>& p) { return p.size() == 1 ? p[0] : 0.0; };
  const auto best = best_assignments(3, cost, 4);
  EXPECT_EQ(best, (std::vector<std::vector<int>>{{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}}));
  EXPECT_EQ(best_assignments(3, cost, 10).size(), 6u);
}

TEST(BestAssignments, CompleteFirstColumnsWithTheOthersInTheirOrder) {
  EXPECT_EQ(completed({2}, 4), (std::vector<int>{2, 0, 1, 3}));
  EXPECT_EQ(completed({}, 2), (std::vector<int>{0, 1}));
}

TEST(BestAssignments, LeavesEachColumnInItsPlaceIfOthersAreNotBetter) {
  EXPECT_EQ(best_assignments(
                4, [](const std::vector<int>&) { return 1; }, 1),
            (std::vector<std::vector<int>>{{0, 1, 2, 3}}));
}

TEST(BestAssignments, IsEmptyIfNoneIsPossible) {
  const PlaceCost cost = [](const std::vector<int>& p) { return p.size() == 2 ? kImpossible : 0; };
  EXPECT_TRUE(best_assignments(3, cost, 1).empty());
}

TEST(BestAssignments, DoesNotContinueWhatCostsMoreThanTheBestSoFar) {
  int asked = 0;
  const PlaceCost cost = [&](const std::vector<int>& p) {
    ++asked;
    return p.back() == (static_cast<int>(p.size()) + 1) % 7 ? 0.0 : 1.0;
  };
  EXPECT_EQ(best_assignments(7, cost, 1), (std::vector<std::vector<int>>{{2, 3, 4, 5, 6, 0, 1}}));
  EXPECT_EQ(asked, 7 + 6 + 5 + 4 + 3 + 2 + 1) << "each column that is left, once for each place";
}

}  // namespace
}  // namespace halyard

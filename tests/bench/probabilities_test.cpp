#include "bench/diagnosis/summary/probabilities.h"

#include <gtest/gtest.h>

#include "bench/diagnosis/summary/acceptance.h"
#include "tests/bench/trials.h"

namespace halyard::blind {
namespace {

constexpr double kRoundingOfShare = 1e-12;

/// So many claims of one probability, of which some came true.
void add(std::vector<Claim>& claims, double probability, int came_true, int of) {
  for (int i = 0; i < of; ++i) claims.push_back({probability, i < came_true});
}

void expect_group(const ClaimGroup& group, double from, double to, int came_true, int of) {
  EXPECT_NEAR(group.from, from, kRoundingOfShare);
  EXPECT_NEAR(group.to, to, kRoundingOfShare);
  EXPECT_EQ(group.came_true.hits, came_true);
  EXPECT_EQ(group.came_true.of, of);
}

TEST(ProbabilitiesOfTrials, OfFullBinsAreComparedBinByBin) {
  std::vector<Claim> claims;
  add(claims, 0.05, 1, 20);
  add(claims, 1, 18, 20);
  const std::vector<ClaimGroup> groups = groups_of(claims);
  ASSERT_EQ(groups.size(), 2u);
  expect_group(groups[0], 0, 0.1, 1, 20);
  expect_group(groups[1], 0.9, 1, 18, 20);
  EXPECT_NEAR(groups[1].distance(), 0.1, kRoundingOfShare);
  EXPECT_NEAR(farthest_group(claims)->distance(), 0.1, kRoundingOfShare);
}

TEST(ProbabilitiesOfTrials, OfSparseNeighboursAreComparedTogether) {
  std::vector<Claim> claims;
  add(claims, 0.55, 2, 10);
  add(claims, 0.75, 2, 10);  // the bin between is empty
  add(claims, 0.95, 38, 40);
  const std::vector<ClaimGroup> groups = groups_of(claims);
  ASSERT_EQ(groups.size(), 2u);
  expect_group(groups[0], 0.5, 0.8, 4, 20);
  EXPECT_NEAR(groups[0].mean(), 0.65, kRoundingOfShare);
  expect_group(*farthest_group(claims), 0.5, 0.8, 4, 20);
}

TEST(ProbabilitiesOfTrials, OfTooFewNeighboursAreComparedWithTheSmallerGroupBesideThemWhichCountsAloneToo) {
  std::vector<Claim> claims;
  add(claims, 0.05, 0, 50);
  add(claims, 0.5, 0, 19);
  add(claims, 0.95, 30, 30);
  const std::vector<ClaimGroup> groups = groups_of(claims);
  ASSERT_EQ(groups.size(), 3u);
  expect_group(groups[0], 0, 0.1, 0, 50);
  expect_group(groups[1], 0.5, 1, 30, 49);
  expect_group(groups[2], 0.9, 1, 30, 30);
  add(claims, 0.95, 30, 30);
  expect_group(groups_of(claims)[1], 0, 0.6, 0, 69);
}

TEST(ProbabilitiesOfTrials, HaveNoDistanceOfFewClaims) {
  std::vector<Claim> claims;
  EXPECT_TRUE(groups_of(claims).empty());
  add(claims, 0.3, 10, 10);
  add(claims, 0.9, 0, 9);
  ASSERT_EQ(groups_of(claims).size(), 1u);
  expect_group(groups_of(claims)[0], 0.3, 1, 10, 19);
  EXPECT_FALSE(farthest_group(claims));
}

TEST(ProbabilitiesOfTrials, OfNamesAreTrueIfTheEffectIsHiddenOrTrueBesideIt) {
  Result r = trial(Kind::two_at_joint, {true_effect("backlash", 1), true_effect("creep", 1)},
                   {named("backlash", 1, 0.9, {{{"creep", 1}, 0.05, true}, {{"delay", 0}, 0.04, false}}),
                    named("delay", 0, 0.7, {{{"backlash", 1}, 0.2, true}}), named("slack", 2, 0.6)});
  r.also_true = {{"delay", 0}};
  std::vector<std::pair<double, bool>> claims;
  for (const Claim& c : claims_of({&r}, ClaimKind::names)) claims.emplace_back(c.probability, c.came_true);
  const std::vector<std::pair<double, bool>> expected = {
      {0.9, true},
      {0.05, true},  // no name is right about the creep, and nothing is claimed about the alternative delay
      {0.7, true},
      {0.2, false},  // the backlash has its name
      {0.6, false}};
  EXPECT_EQ(claims, expected);
}

TEST(ProbabilitiesOfTrials, OfNamesAreSharesOfThoseThatAreRightOrFalse) {
  Result r = trial(Kind::effect, {true_effect("backlash", 1)},
                   {named("backlash", 1, 0.95), named("backlash", 1, 0.91), named("delay", 0, 0.99),
                    named("slack", 2, 0.9), named("creep", 3, 0.4)});
  r.also_true = {{"delay", 0}};
  const RightNames right = right_names({&r});
  EXPECT_EQ(right.above_90.hits, 1);
  EXPECT_EQ(right.above_90.of, 2);
  EXPECT_EQ(right.others.hits, 0);
  EXPECT_EQ(right.others.of, 2);
}

TEST(ProbabilitiesOfTrials, OfCleanAndOfNoneAreNotCountedWhereBothMayBeRight) {
  Result clean = trial(Kind::clean, {}, {});
  clean.probability_clean = 0.8, clean.probability_none = 0.2;
  Result outside = trial(Kind::outside, {true_effect("hum", 1)}, {});
  outside.probability_clean = 0.1, outside.probability_none = 0.9;
  Result small = outside, wide = clean;
  small.truth[0].seen_from = 2;
  wide.situation.off = 2;
  const Results all = {&clean, &outside, &small, &wide};
  ASSERT_EQ(claims_of(all, ClaimKind::clean).size(), 2u);
  EXPECT_TRUE(claims_of(all, ClaimKind::clean)[0].came_true);
  EXPECT_FALSE(claims_of(all, ClaimKind::clean)[1].came_true);
  ASSERT_EQ(claims_of(all, ClaimKind::none).size(), 2u);
  EXPECT_FALSE(claims_of(all, ClaimKind::none)[0].came_true);
  EXPECT_TRUE(claims_of(all, ClaimKind::none)[1].came_true);
}

TEST(ProbabilitiesOfTrials, HaveALineForEachKindOfClaim) {
  // 20 clean arms that are told apart well, and 20 names at 0.95 of which half are false.
  std::vector<Result> ran;
  for (int i = 0; i < 20; ++i) {
    ran.push_back(trial(Kind::clean, {}, {}));
    ran.back().probability_clean = 0.98, ran.back().probability_none = 0.02;
    ran.push_back(
        trial(Kind::effect, {true_effect("backlash", 1)}, {named(i % 2 == 0 ? "backlash" : "slack", 1, 0.95)}));
  }
  const std::string table = acceptance_table(pointers(ran));
  EXPECT_NE(table.find("probabilities of names and their alternatives: largest distance from the observed frequency: "
                       "45.0 points, between 0.9 and 1.0, which claim 95.0 % on average | 5 points | 10/20 |"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("probabilities of `clean`: largest distance from the observed frequency: 2.0 points"),
            std::string::npos)
      << table;
}

}  // namespace
}  // namespace halyard::blind

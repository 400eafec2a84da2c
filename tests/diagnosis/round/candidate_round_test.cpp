#include "diagnosis/round/candidate_round.h"

#include <gtest/gtest.h>

namespace halyard {
namespace {

constexpr double kQuarter = 0.25;
Prospect judged(double gain, double left) { return {true, gain, left}; }

TEST(Leaders, AreThoseThatGainMost) {
  EXPECT_EQ(leaders_of({judged(40, 10), judged(30, 11), judged(9, 12), judged(1, 13)}, kQuarter),
            (std::vector<std::size_t>{0, 1}));
}

TEST(Leaders, IncludeOneThatLeavesLittleAndGainsNothingYet) {
  EXPECT_EQ(leaders_of({judged(40, 100), judged(30, 110), judged(-5, 20)}, kQuarter),
            (std::vector<std::size_t>{0, 1, 2}));
}

TEST(Leaders, MayComeInAnyOrder) {
  EXPECT_EQ(leaders_of({judged(9, 12), judged(30, 11), judged(40, 10)}, kQuarter), (std::vector<std::size_t>{2, 1}));
}

TEST(Leaders, ByGainAreJudged) {
  EXPECT_EQ(leaders_of({{false, 40, 30}, judged(30, 20), judged(1, 10)}, kQuarter), (std::vector<std::size_t>{1, 2}));
}

TEST(Leaders, ByRestNeedNotBeJudged) {
  EXPECT_EQ(leaders_of({{false, 1, 10}, judged(30, 100)}, kQuarter), (std::vector<std::size_t>{1, 0}));
}

constexpr double kWithout = 200;
const Prospect kStanding = judged(90, 20);

TEST(Rivals, GainMuchOfWhatTheNameGains) {
  EXPECT_TRUE(is_rival(judged(31, 150), 0.9, kStanding, kWithout));
  EXPECT_FALSE(is_rival(judged(29, 150), 0.9, kStanding, kWithout));
}

TEST(Rivals, MayLeaveLittleAndGainNothingYet) {
  EXPECT_TRUE(is_rival(judged(-5, 109), 0, kStanding, kWithout));
  EXPECT_FALSE(is_rival(judged(-5, 111), 0, kStanding, kWithout));
}

TEST(Rivals, ExplainTheSamePart) { EXPECT_FALSE(is_rival(judged(100, 10), 0.4, kStanding, kWithout)); }

TEST(Leaders, CanBeIntegrated) { EXPECT_TRUE(leaders_of({Prospect{}}, kQuarter).empty()); }

TEST(Leaders, ThatGainNothingAreTheTwoThatLeaveLeast) {
  EXPECT_EQ(leaders_of({judged(0, 12), judged(0, 11), judged(0, 13), judged(0, 10)}, kQuarter),
            (std::vector<std::size_t>{3, 1}));
}

TEST(Leaders, AreAtMostFourByGainAndTwoByRest) {
  std::vector<Prospect> all;
  for (int i = 0; i < 8; ++i) all.push_back(judged(40 - i, 100 - i));
  EXPECT_EQ(leaders_of(all, kQuarter), (std::vector<std::size_t>{0, 1, 2, 3, 7, 6}));
}

TEST(Rivals, AreThoseAtTheEdgesToo) {
  EXPECT_TRUE(is_rival(judged(kRule.rivals * kStanding.gain, 150), kRule.shared_gain, kStanding, kWithout));
  EXPECT_TRUE(is_rival(judged(0, 110), 0, kStanding, kWithout)) << "it takes half as much away, and gains nothing";
}

}  // namespace
}  // namespace halyard

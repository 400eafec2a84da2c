#include "diagnosis/search/candidate_round.h"

#include <gtest/gtest.h>

namespace halyard {
namespace {

Prospect judged(double gain, double left) { return {true, gain, left}; }

TEST(Leaders, AreThoseThatGainMost) {
  EXPECT_EQ(leaders_of({judged(40, 10), judged(30, 11), judged(9, 12), judged(1, 13)}),
            (std::vector<std::size_t>{0, 1}));
}

TEST(Leaders, IncludeOneThatLeavesLittleAndGainsNothingYet) {
  EXPECT_EQ(leaders_of({judged(40, 100), judged(30, 110), judged(-5, 20)}), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(Leaders, AreJudged) {
  EXPECT_EQ(leaders_of({{false, 40, 10}, judged(30, 100)}), (std::vector<std::size_t>{1}));
  EXPECT_TRUE(leaders_of({{false, 40, 10}}).empty());
}

}  // namespace
}  // namespace halyard

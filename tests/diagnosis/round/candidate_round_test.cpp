#include "diagnosis/round/candidate_round.h"

#include <gtest/gtest.h>

#include <vector>

#include "diagnosis/round/refit.h"
#include "tests/diagnosis/fit/made_log.h"

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

constexpr double kZero = 0.1;  // rad

/// A round about the log of an arm whose zero is off, and of which only the joint's sensor is compared.
struct ZeroRound {
  ArmModel model = first_joints(1);
  Evidence evidence;
  Refitter refitter{evidence, model, 0};
  Judge judge{evidence, model, refitter.numbers()};
  Hypothesis nominal{model.nominal, {}};
  SearchProgress quiet = [](const std::string&, double) {};
  CandidateRound round{evidence, model, refitter, judge, {nominal, evidence.score(nominal)}, nominal, "a round", quiet};
  /// The friction of a motor moves no joint.
  std::vector<Trial> trials = round.look({placed("motor_friction"), placed("encoder_offset")});

  ZeroRound() : evidence(make_records(log(), model, {}), model) {}
  PlacedEffect placed(const char* name) const { return place_effect(*find_effect(name), model.nominal, 0); }
  static Log log() {
    Log made = log_along(4, 100, slow_swing);
    for (double& q : made.joint_position[0]) q -= kZero;
    return made;
  }
};

TEST(CandidateRound, TakesAQuickLookAtWhatPromisesSomethingAndTellsTheLargestGainFirst) {
  const ZeroRound r;
  ASSERT_EQ(r.trials.size(), 2u);
  const Trial &zero = r.trials[0], &friction = r.trials[1];
  EXPECT_EQ(zero.effect.effect->name(), "encoder_offset");
  EXPECT_TRUE(zero.promising && zero.is_fitted && zero.usable);
  EXPECT_GT(zero.gain, 10);
  EXPECT_EQ(friction.effect.effect->name(), "motor_friction");
  EXPECT_FALSE(friction.promising || friction.is_fitted || friction.usable);
}

TEST(CandidateRound, FitsItsLeaderFullyAndNobodyElse) {
  ZeroRound r;
  const std::vector<Fit> fits = r.round.fit_leaders(r.trials);
  ASSERT_EQ(fits.size(), 2u);
  ASSERT_TRUE(fits[0].usable);
  EXPECT_NEAR(fits[0].hypothesis.effects.at(0).p[0], kZero, 2e-3) << "the cable's stretch is 2e-4";
  EXPECT_TRUE(r.trials[0].can_be_named());
  EXPECT_FALSE(fits[1].usable);
}

TEST(CandidateRound, FitsANameOnceMoreIfItsQuickFitGainsMoreThanItsPresentOne) {
  ZeroRound r;
  Hypothesis with = r.nominal;
  with.effects = {r.placed("encoder_offset")};
  with.effects[0].p[0] = kZero;
  const auto is_fitted = [&](double less) {
    Trial standing = r.trials[0];
    standing.gain -= less;
    r.round.keep_rivals_of(standing, with, r.trials);
    std::vector<Trial> trials = r.trials;
    return r.round.fit_leaders(trials)[0].usable;
  };
  EXPECT_FALSE(is_fitted(0));
  EXPECT_TRUE(is_fitted(1));
}

}  // namespace
}  // namespace halyard

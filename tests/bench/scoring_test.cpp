/// Tables of what is right, see scoring.h: a change of the rule changes a line of them.

#include "bench/diagnosis/results/scoring.h"

#include <gtest/gtest.h>

#include "tests/bench/trials.h"

namespace halyard::blind {
namespace {

/// A diagnosis and what it counts as.
struct Scored {
  const char* what;
  std::vector<Named> names;
  bool strict, loose;
  std::string verdict = "";  ///< empty: effects if there are names, else clean
  std::vector<int> unexplained = {};
};

void expect_scores(Kind kind, const std::vector<TrueEffect>& truth, const std::vector<Scored>& table) {
  for (const Scored& line : table) {
    Result r = trial(kind, truth, line.names);
    if (!line.verdict.empty()) r.verdict = line.verdict;
    r.unexplained = line.unexplained;
    r.also_true = {{"delay", 0}};
    EXPECT_EQ(strictly_right(r), line.strict) << word(kind) << ": " << line.what;
    EXPECT_EQ(loosely_right(r), line.loose) << word(kind) << ": " << line.what;
    r.failure = "diagnose: it threw";
    EXPECT_FALSE(strictly_right(r) || loosely_right(r)) << word(kind) << ", failed: " << line.what;
  }
}

const Named kRight = named("backlash", 1), kAlso = named("delay", 0), kFalse = named("slack", 1),
            kElsewhere = named("backlash", 2);

Alternative or_else(const std::string& effect) { return {{effect, 1}, 0.2, true}; }

Named false_name_or(const std::vector<Alternative>& alternatives) { return named("slack", 1, 0.6, alternatives); }

TEST(ScoreOfATrial, OfACleanArm) {
  expect_scores(Kind::clean, {},
                {{"clean", {}, true, true},
                 {"unknown", {}, false, true, "unknown", {1}},
                 {"a name that is true, too", {kAlso}, false, true},
                 {"a false name", {kFalse}, false, false},
                 {"a false name beside one that is true, too", {kAlso, kFalse}, false, false}});
}

TEST(ScoreOfATrial, OfOneEffectOrAnotherForm) {
  const Alternative right = or_else("backlash"), other = or_else("creep"), third = or_else("hysteresis");
  for (const Kind kind : {Kind::effect, Kind::form})
    expect_scores(kind, {kBacklash},
                  {{"the right name", {kRight}, true, true},
                   {"beside a name that is true, too", {kAlso, kRight}, true, true},
                   {"with a residual left", {kRight}, false, true, "", {2}},
                   {"a false name second", {kRight, kFalse}, false, true},
                   {"a second name for the same effect", {kRight, kRight}, false, true},
                   {"a false name first", {kFalse, kRight}, false, false},
                   {"at another joint", {kElsewhere}, false, false},
                   {"the first of two alternatives", {false_name_or({right, other})}, false, true},
                   {"the second of two alternatives", {false_name_or({other, right})}, false, true},
                   {"one of three alternatives", {false_name_or({right, other, third})}, false, false},
                   {"an alternative of the second name", {kFalse, false_name_or({right})}, false, false},
                   {"an alternative behind a name that is true, too", {kAlso, false_name_or({right})}, false, true},
                   {"no name", {}, false, false},
                   {"unknown", {}, false, false, "unknown", {1}},
                   {"only a name that is true, too", {kAlso}, false, false}});
}

TEST(ScoreOfATrial, OfSeveralEffects) {
  const Named creep = named("creep", 1);
  for (const Kind kind : {Kind::two_at_joint, Kind::three})
    expect_scores(kind, {kBacklash, kCreep},
                  {{"both", {kRight, creep}, true, true},
                   {"both, the other first", {creep, kRight}, true, true},
                   {"both and one that is true, too", {kRight, creep, kAlso}, true, true},
                   {"both and a false one", {kRight, creep, kFalse}, false, true},
                   {"both, and a residual left", {kRight, creep}, false, true, "", {1}},
                   {"one of them", {kRight}, false, false},
                   {"the other is an alternative", {kRight, false_name_or({or_else("creep")})}, false, false},
                   {"none", {}, false, false}});
}

TEST(ScoreOfATrial, OfSeveralEffectsAsksOnlyForThoseThatCanBeSeen) {
  TrueEffect small = kCreep;
  small.seen_from = 1.01;
  expect_scores(Kind::two_at_joint, {kBacklash, small},
                {{"the one that can be seen", {kRight}, true, true},
                 {"both", {kRight, named("creep", 1)}, true, true},
                 {"the one that cannot be seen", {named("creep", 1)}, false, false}});
  small.seen_from = 1;
  expect_scores(Kind::two_at_joint, {kBacklash, small}, {{"one of two that can be seen", {kRight}, false, false}});
}

TEST(ScoreOfATrial, OfACauseOutsideTheLibrary) {
  const Named itself = named("quadratic_drag", 1), claim = named("joint_friction", 1, 0.51),
              no_claim = named("joint_friction", 1, 0.5);
  expect_scores(Kind::outside, {true_effect("quadratic_drag", 1)},
                {{"unknown", {}, true, true, "unknown", {1}},
                 {"unknown, although nothing is told", {}, true, true, "unknown"},
                 {"unknown with a name that is no claim", {no_claim}, true, true, "unknown"},
                 {"unknown with a claim", {claim}, false, true, "unknown"},
                 {"a name, and a residual left", {claim}, false, true, "", {1}},
                 {"a name that is no claim, and a residual left", {no_claim}, false, true, "", {1}},
                 {"a name alone", {claim}, false, false},
                 {"its own name, which no diagnosis has", {itself}, false, false},
                 {"clean", {}, false, false}});
}

TEST(ScoreOfATrial, CountsFalseNames) {
  Result r = trial(Kind::effect, {kBacklash}, {kRight, kRight, kAlso, kFalse, kElsewhere});
  r.also_true = {{"delay", 0}};
  EXPECT_EQ(score_names(r), (std::vector{NameScore::right, NameScore::false_name, NameScore::also_true,
                                         NameScore::false_name, NameScore::false_name}));
  EXPECT_EQ(false_names(r), 3);
}

TEST(ScoreOfATrial, IsThatOfATooSmallEffectOnlyIfNoneCanBeSeen) {
  TrueEffect small = kCreep;
  small.seen_from = 2;
  EXPECT_TRUE(is_too_small(trial(Kind::effect, {small}, {})));
  EXPECT_FALSE(is_too_small(trial(Kind::three, {small, kBacklash}, {})));
  EXPECT_FALSE(is_too_small(trial(Kind::clean, {}, {})));
}

}  // namespace
}  // namespace halyard::blind

#include "diagnosis/search/naming.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

TEST(Naming, IsAsProbableAsItsNamesTogetherWhereOneOfThemIsRight) {
  Naming naming;
  naming.weight = 0.5;
  naming.alternatives = {{PlacedEffect{}, 0.3, false}, {PlacedEffect{}, 0.1, false}};
  EXPECT_DOUBLE_EQ(probability_of_any_name(naming, 0), 0.9);
  EXPECT_DOUBLE_EQ(probability_of_any_name(naming, 0.5), 0.45);
  EXPECT_DOUBLE_EQ(probability_of_any_name(naming, 1), 0);
}

TEST(Naming, TwoEffectsCostMoreThanOneWithTheirNumbers) {
  const ArmParameters<double> arm = first_joints(1).nominal;
  const auto cost = [&](const char* name) { return prior_cost_of(place_effect(*find_effect(name), arm, 0), arm); };
  EXPECT_NEAR(cost("backlash") - cost("capstan_ratio"), 2 * kRule.cost_of_number, 1e-12)
      << "3 numbers with its equation";
  EXPECT_GT(2 * cost("capstan_ratio"), cost("backlash"));
}

TEST(Convincing, AreThoseWhoseRateOfFalseDiscoveriesIsSmallAmongAllThatWereFitted) {
  const auto with_p = [](double p) {
    Trial t;
    t.usable = t.matters = true;
    t.gain = 1, t.p_value = p;
    return t;
  };
  std::vector<Trial> trials = {with_p(0.001), with_p(0.004), with_p(1e-5), with_p(1e-5)};
  trials[2].is_fitted = false;
  trials[3].matters = false;
  // Three tests; the last cannot be named, and its p counts as 1. The rates are 0.003, 0.006 and 1.
  EXPECT_EQ(convincing(trials, 0.0025), (std::vector<bool>{false, false, false, false}));
  EXPECT_EQ(convincing(trials, 0.0035), (std::vector<bool>{true, false, false, false}));
  EXPECT_EQ(convincing(trials, 0.0065), (std::vector<bool>{true, true, false, false}));
}

/// Candidates of a round on a log that is made by hand; their likelihoods are made up.
class CompetitionTest : public testing::Test {
 protected:
  static constexpr std::size_t kTorque = 0, kJoint = 1;

  /// With so many nats more in a channel: spread unevenly over its deciding blocks, or all in the first of them.
  static Likelihood more(Likelihood ln, double nats, std::size_t channel = kJoint, bool in_one_block = false) {
    std::vector<std::size_t> blocks;
    for (std::size_t b = 0; b < ln.size(); ++b)
      if (made_evidence().block_count()[b][channel] > 0) blocks.push_back(b);
    const auto part = [&](std::size_t i) { return in_one_block ? (i == 0 ? 1.0 : 0.0) : (i % 2 == 0 ? 3.0 : 1.0); };
    double all = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) all += part(i);
    for (std::size_t i = 0; i < blocks.size(); ++i) ln[blocks[i]][channel] += nats * part(i) / all;
    return ln;
  }
  Trial trial(const Likelihood& ln, double gain = 1) const {
    Trial t;
    t.effect = place_effect(*find_effect("encoder_offset"), model_.nominal, 0);
    t.usable = t.matters = true;
    t.p_value = 1e-6, t.gain = gain;
    t.log_likelihood = ln;
    return t;
  }
  Competition competition(const std::vector<Trial>& trials) const {
    return {made_evidence(), model_, judge_, without_, trials};
  }
  Naming naming(const std::vector<Trial>& trials, const std::vector<std::size_t>& alike = {0}) const {
    return competition(trials).naming({0, alike});
  }

  const ArmModel model_ = first_joints(1);
  const Judge judge_{made_evidence(), model_, {}};
  const Scored without_{{model_.nominal, {}}, made_evidence().score({model_.nominal, {}})};
  const Likelihood none_ = log_likelihood(made_evidence(), without_.score, squared_floors(made_evidence()));
};

TEST_F(CompetitionTest, TheDataTellACandidateFromTheBestByEightNatsAndTwoStandardErrors) {
  const auto is_alike = [&](const Likelihood& best, const Likelihood& other) {
    const std::vector<Trial> trials = {trial(best, 2), trial(other, 1)};
    return competition(trials).choose({0, 1}).alike.size() == 2;
  };
  const Likelihood hundred = more(none_, 100);
  EXPECT_TRUE(is_alike(hundred, more(none_, 92.5)));
  EXPECT_FALSE(is_alike(hundred, more(none_, 91.5)));
  EXPECT_TRUE(is_alike(more(hundred, 20, kJoint, true), hundred)) << "in a single block: one standard error";
  EXPECT_FALSE(is_alike(hundred, more(none_, 99, kTorque))) << "it explains another part";
}

TEST_F(CompetitionTest, OfThoseThatLookAlikeTheMostProbableIsNamed) {
  const auto named = [&](double cost_of_best) {
    std::vector<Trial> trials = {trial(more(none_, 99), 1), trial(more(none_, 100), 2)};
    trials[1].prior_cost = cost_of_best;
    return competition(trials).choose({0, 1}).named;
  };
  EXPECT_EQ(named(0), 1u);
  EXPECT_EQ(named(5), 0u);
}

TEST_F(CompetitionTest, AlternativesAreToldIfTheyHaveAHundredthOfTheWeightOrLookAlike) {
  const auto told = [&](double cost, const std::vector<std::size_t>& alike) {
    std::vector<Trial> trials(2, trial(more(none_, 100)));
    trials[1].prior_cost = cost;
    return naming(trials, alike).alternatives.size();
  };
  EXPECT_EQ(told(4, {0}), 1u) << "1.8 %";
  EXPECT_EQ(told(6, {0}), 0u) << "0.2 %";
  EXPECT_EQ(told(6, {0, 1}), 1u);
}

TEST_F(CompetitionTest, AnAlternativeGainsAndIsNoRefitAndExplainsTheSame) {
  const auto has_one = [&](const std::function<void(Trial&)>& change) {
    std::vector<Trial> trials(2, trial(more(none_, 100)));
    change(trials[1]);
    return !naming(trials).alternatives.empty();
  };
  EXPECT_TRUE(has_one([](Trial&) {}));
  EXPECT_FALSE(has_one([](Trial& t) { t.gain = 0; }));
  EXPECT_FALSE(has_one([](Trial& t) { t.is_refit = true; }));
  EXPECT_FALSE(has_one([](Trial& t) { t.usable = false; }));
  EXPECT_FALSE(has_one([](Trial& t) { t.p_value = 0.06; })) << "not significant";
  EXPECT_FALSE(has_one([&](Trial& t) { t.log_likelihood = more(none_, 100, kTorque); }));
}

TEST_F(CompetitionTest, TheMostProbableAlternativeComesFirst) {
  std::vector<Trial> trials(3, trial(more(none_, 100)));
  trials[1].prior_cost = 2, trials[2].prior_cost = 1;
  const std::vector<Alternative> all = naming(trials).alternatives;
  ASSERT_EQ(all.size(), 2u);
  EXPECT_NEAR(all[0].probability / all[1].probability, std::exp(1), 1e-9);
}

TEST_F(CompetitionTest, NoEffectIsWeighedAgainstThoseThatCanBeNamed) {
  std::vector<Trial> trials = {trial(none_)};
  // An effect costs 1.5 nats and its only number 0.5. It explains no more than none.
  EXPECT_NEAR(competition(trials).weight_of_no_effect(), 1 / (1 + std::exp(-2)), 1e-9);
  trials[0].at_bound = true;
  EXPECT_NEAR(competition(trials).weight_of_no_effect(), 1, 1e-9) << "it cannot be named";
}

}  // namespace
}  // namespace halyard

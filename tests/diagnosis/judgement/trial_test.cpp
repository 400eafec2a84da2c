/// When a candidate can be named, and the probability of a gain by chance, of scores that are made by hand.

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/judgement/judge.h"
#include "diagnosis/judgement/nested_gain.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/small_evidence.h"

namespace halyard {
namespace {

template <class Change>
Trial good_trial_but(const Change& change) {
  Trial t;
  t.usable = t.matters = true;
  t.gain = 1;
  t.p_value = 0.01;
  change(t);
  return t;
}

TEST(Trial, CanBeNamedIfNothingSpeaksAgainstIt) {
  EXPECT_TRUE(good_trial_but([](Trial&) {}).can_be_named());
  EXPECT_FALSE(good_trial_but([](Trial& t) { t.usable = false; }).can_be_named());
  EXPECT_FALSE(good_trial_but([](Trial& t) { t.p_value = 0.06; }).can_be_named()) << "not significant";
  EXPECT_FALSE(good_trial_but([](Trial& t) { t.gain = 0; }).can_be_named());
  EXPECT_FALSE(good_trial_but([](Trial& t) { t.at_bound = true; }).can_be_named());
  EXPECT_FALSE(good_trial_but([](Trial& t) { t.is_refit = true; }).can_be_named());
  EXPECT_FALSE(good_trial_but([](Trial& t) { t.matters = false; }).can_be_named());
  EXPECT_FALSE(good_trial_but([](Trial& t) { t.is_another = true; }).can_be_named());
}

TEST(Trial, PassesATestOfItsOwnSignificanceAndNoStricterOne) {
  const Trial t = good_trial_but([](Trial&) {});
  EXPECT_TRUE(t.passes(0.01));
  EXPECT_FALSE(t.passes(0.0099));
}

TEST(Trial, OfWhatCannotBeIntegratedGainsNothing) {
  const Trial t = unusable(place_effect(*find_effect("backlash"), first_joints(1).nominal, 0));
  EXPECT_EQ(t.effect.effect->name(), "backlash");
  EXPECT_EQ(t.gain, 0);
  EXPECT_EQ(t.p_value, 1);
  EXPECT_FALSE(t.is_judged());
}

/// A score whose deciding rows are all 1, and the mean square of the last channel so many times that of a rest.
Score score_with_rest(const Evidence& evidence, double of_rest) {
  Score s;
  s.mean_square.assign(2, 0);
  s.mean_square[1] = of_rest * std::pow(kRule.rest_ratio * evidence.floor()[1], 2);
  std::size_t rows = 0;
  for (const auto& block : evidence.block_count())
    for (const int n : block) rows += static_cast<std::size_t>(n);
  s.deciding.assign(rows, 1);
  s.block_sum = evidence.block_products(s.deciding, s.deciding);
  return s;
}

TEST(Trial, ThatExplainsAWholeRestIsTestedTwice) {
  const ArmModel model = first_joints(1);
  const Evidence evidence = brief_evidence();
  const Judge judge(evidence, model, {});
  const Score before = score_with_rest(evidence, 1.01);
  // No block changes: half of all gains are larger by chance, and the likelihood ratio is 1.
  EXPECT_DOUBLE_EQ(judge.p_of_gain(score_with_rest(evidence, 1.005), before), 0.5) << "a rest is left";
  EXPECT_DOUBLE_EQ(judge.p_of_gain(score_with_rest(evidence, 0.99), before), 1) << "twice the smaller one";
}

TEST(Trial, ThatLeavesNextToNothingOfARestIsTestedTwice) {
  const ArmModel model = first_joints(1);
  const Judge judge(made_evidence(), model, {});
  const Score before = score_with_rest(made_evidence(), 1000);
  // A tenth of the root mean square is a hundredth of the mean square.
  EXPECT_DOUBLE_EQ(judge.p_of_gain(score_with_rest(made_evidence(), 10.1), before), 0.5);
  EXPECT_DOUBLE_EQ(judge.p_of_gain(score_with_rest(made_evidence(), 9.9), before), 1) << "twice the smaller one";
}

TEST(Trial, ThatExplainsAWholeRestInFewBlocksHasTwiceItsLikelihoodRatio) {
  const ArmModel model = first_joints(1);
  const Evidence& evidence = made_evidence();
  const Judge judge(evidence, model, {});
  const Score before = score_with_rest(evidence, 1.01);
  Score after = score_with_rest(evidence, 0.99);
  double rows = 0;
  for (const auto& block : evidence.block_count()) rows += block[1];
  constexpr double kGain = 3;  // nats; what the blocks have in common says nothing
  for (auto& block : after.block_sum) block[1] *= std::exp(-2 * kGain * evidence.correlated_rows(1) / rows);
  // The floor of 2e-5 is added to a mean square of one.
  EXPECT_NEAR(judge.p_of_gain(after, before), 2 * std::exp(-kGain), 1e-6);
  Score worse = after;
  for (std::size_t r = 0; r < worse.deciding.size(); ++r) worse.deciding[r] = r % 3 == 0 ? 1.3 : 1.1;
  worse.block_sum = evidence.block_products(worse.deciding, worse.deciding);
  EXPECT_EQ(judge.p_of_gain(worse, before), 1) << "a probability";
}

/// The same for both channels: of the torque's rest and of the joint's.
Score score_with_rests(const Evidence& evidence, const std::pair<double, double>& of_rest) {
  Score s = score_with_rest(evidence, of_rest.second);
  s.mean_square[0] = of_rest.first * std::pow(kRule.rest_ratio * evidence.floor()[0], 2);
  return s;
}

TEST(Trial, IsTestedTwiceIfNothingIsLeftOfTheRestOfWhichItExplainsMost) {
  const ArmModel model = first_joints(1);
  const Judge judge(made_evidence(), model, {});
  using Rests = std::pair<double, double>;
  const auto p = [&](const Rests& before, const Rests& after) {
    return judge.p_of_gain(score_with_rests(made_evidence(), after), score_with_rests(made_evidence(), before));
  };
  // No block changes: once the probability is a half, twice the smaller one is 1.
  EXPECT_DOUBLE_EQ(p({2, 100}, {1.5, 0.9}), 1) << "the joint's is gone";
  EXPECT_DOUBLE_EQ(p({100, 2}, {0.9, 1.5}), 1) << "the torque's is gone";
  EXPECT_DOUBLE_EQ(p({100, 1.01}, {30, 0.99}), 0.5) << "it explains most of the torque's, of which some is left";
  EXPECT_DOUBLE_EQ(p({100, 0.5}, {50, 1e-3}), 0.5) << "the joint had no rest";
  EXPECT_DOUBLE_EQ(p({0.5, 100}, {1e-3, 50}), 0.5) << "nor had the torque";
}

TEST(Trial, HardlyCountsBlocksWithNextToNothingOfTheResidual) {
  const ArmModel model = first_joints(1);
  const Evidence& evidence = made_evidence();
  const Judge judge(evidence, model, {});
  Score before = score_with_rest(evidence, 1), after = before;
  // Of the whole channels, which have much more than these blocks. A rest is left of both.
  before.mean_square = {400, 900}, after.mean_square = {399, 899};
  for (std::size_t r = 0; r < before.deciding.size(); ++r) {
    before.deciding[r] = 1 + static_cast<double>(r % 7);
    after.deciding[r] = (r % 3 == 0 ? 0.2 : 0.7) * before.deciding[r];
  }
  for (Score* s : {&before, &after}) s->block_sum = evidence.block_products(s->deciding, s->deciding);
  std::vector<double> least = squared_floors(evidence);
  least[0] += 4, least[1] += 9;  // a tenth of the root mean square
  const double expected = p_value(paired(nested_gains(evidence, after, before, least)));
  EXPECT_NEAR(judge.p_of_gain(after, before), expected, 1e-6 * expected);
}

}  // namespace
}  // namespace halyard

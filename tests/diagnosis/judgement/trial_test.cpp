/// When a candidate can be named, and the probability of a gain by chance, of scores that are made by hand.

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/judgement/judge.h"
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

}  // namespace
}  // namespace halyard

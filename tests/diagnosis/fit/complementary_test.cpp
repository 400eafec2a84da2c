#include "diagnosis/fit/complementary.h"

#include <gtest/gtest.h>

#include "tests/support/small_evidence.h"

namespace halyard {
namespace {

/// A fit of two effects of a kind at joint 2 that has kept the parameters of these indices.
Fit fit_of(const Evidence& evidence, const std::string& effect, const std::vector<std::vector<int>>& kept) {
  const ArmParameters<double> arm = first_joints(2).nominal;
  Fit fit;
  fit.hypothesis.nominal = arm;
  fit.parameters.push_back(baseline_parameters(first_joints(2)).front());
  for (std::size_t e = 0; e < kept.size(); ++e) {
    PlacedEffect placed = place_neutral_effect(*find_effect(effect), arm, 1);
    for (const int i : kept[e]) placed.p[i] = 10.0 * static_cast<double>(e + 1) + i;
    fit.hypothesis.effects.push_back(placed);
    for (const FitParameter& p : effect_parameters(evidence, fit.hypothesis, arm, static_cast<int>(e)))
      if (std::ranges::find(kept[e], p.index) != kept[e].end()) fit.parameters.push_back(p);
  }
  return fit;
}

TEST(JoinComplementary, MakesOneForceOfAContactAndAPush) {
  const Evidence evidence = small_evidence();
  const auto joined = join_complementary(fit_of(evidence, "external_force", {{4, 5}, {0, 1, 2, 3}}), 0);
  ASSERT_TRUE(joined.has_value());
  EXPECT_EQ(joined->kept, 0);
  EXPECT_EQ(joined->gone, 1);
  ASSERT_EQ(joined->hypothesis.effects.size(), 1);
  EXPECT_EQ(std::vector<double>(joined->hypothesis.effects[0].p, joined->hypothesis.effects[0].p + 6),
            (std::vector<double>{20, 21, 22, 23, 14, 15}));
  ASSERT_EQ(joined->parameters.size(), 7);
  EXPECT_FALSE(joined->parameters[0].effect);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(joined->parameters[i + 1].effect, 0);
    EXPECT_EQ(joined->parameters[i + 1].index, i) << "in the order of the effect";
  }
}

TEST(JoinComplementary, LeavesOutASizeThatIsNextToNothingBesideTheOthers) {
  const Evidence evidence = small_evidence();
  const auto joined_with = [&](double contact) {
    Fit fit = fit_of(evidence, "external_force", {{4, 5}, {0, 1, 2, 3, 4, 5}});
    fit.hypothesis.effects[1].p[4] = contact;  // beside 14 N/m
    return join_complementary(fit, 0);
  };
  const auto joined = joined_with(0.3);
  ASSERT_TRUE(joined.has_value());
  EXPECT_EQ(std::vector<double>(joined->hypothesis.effects[0].p, joined->hypothesis.effects[0].p + 6),
            (std::vector<double>{20, 21, 22, 23, 14, 15}));
  EXPECT_EQ(joined->parameters.size(), 7);
  EXPECT_FALSE(joined_with(1).has_value());
}

TEST(JoinComplementary, LeavesASmallPushBesideALargeOne) {
  const Evidence evidence = small_evidence();
  Fit fit = fit_of(evidence, "external_force", {{0, 1, 2, 3, 4, 5}, {0, 1, 2, 3}});
  fit.hypothesis.effects[1].p[0] = 0.1;  // beside 10 N
  EXPECT_FALSE(join_complementary(fit, 0)) << "nothing would be left of it";
}

TEST(JoinComplementary, LeavesTwoPushesTwoEffects) {
  const Evidence evidence = small_evidence();
  EXPECT_FALSE(join_complementary(fit_of(evidence, "external_force", {{0, 1, 2, 3}, {0, 1, 2, 3}}), 0));
  EXPECT_FALSE(join_complementary(fit_of(evidence, "external_force", {{0, 1, 2, 3, 4, 5}, {0, 1, 2, 3}}), 0));
}

TEST(JoinComplementary, LeavesRipplesOfTwoOrders) {
  const Evidence evidence = small_evidence();
  Fit fit = fit_of(evidence, "torque_ripple", {{0}, {1}});
  for (PlacedEffect& e : fit.hypothesis.effects) e.p[2] = 6;
  EXPECT_TRUE(join_complementary(fit, 0));
  fit.hypothesis.effects[1].p[2] = 12;
  EXPECT_FALSE(join_complementary(fit, 0));
}

TEST(JoinComplementary, LeavesEffectsThatTheModelCameWith) {
  const Evidence evidence = small_evidence();
  EXPECT_FALSE(join_complementary(fit_of(evidence, "external_force", {{4, 5}, {0, 1, 2, 3}}), 1));
}

}  // namespace
}  // namespace halyard

/// Lists of a fit's parameters: their groups and bounds, and what is left when an effect is gone.

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/fit/fit_parameter.h"
#include "tests/support/small_evidence.h"

namespace halyard {
namespace {

constexpr double kRelative = 1e-12;

FitParameter number_of(std::optional<std::size_t> effect, std::size_t index, bool shape) {
  FitParameter p;
  p.effect = effect, p.index = index, p.shape = shape;
  return p;
}

TEST(ParameterLists, AGroupIsSizesAndTheShapesThatFollowThem) {
  const std::vector<FitParameter> all = {number_of({}, 0, false), number_of(0, 0, false), number_of(0, 1, false),
                                         number_of(0, 2, true),   number_of(0, 3, false), number_of(0, 4, true),
                                         number_of(0, 5, true),   number_of(1, 0, false), number_of(2, 0, false)};
  const std::vector<ParameterGroup> groups = groups_of(all);
  using Indices = std::vector<std::size_t>;
  ASSERT_EQ(groups.size(), 4u);
  EXPECT_EQ(groups[0].sizes, (Indices{1, 2}));
  EXPECT_EQ(groups[0].shapes, Indices{3});
  EXPECT_EQ(groups[1].sizes, Indices{4});
  EXPECT_EQ(groups[1].shapes, (Indices{5, 6}));
  EXPECT_EQ(groups[2].sizes, Indices{7});
  EXPECT_EQ(groups[3].sizes, Indices{8});
  EXPECT_TRUE(groups[2].shapes.empty() && groups[3].shapes.empty());
  EXPECT_TRUE(groups_of({number_of({}, 0, false)}).empty());
}

TEST(ParameterLists, WithoutAnEffectTheLaterOnesMoveUp) {
  const std::vector<FitParameter> left = without_parameters_of(
      {number_of({}, 5, false), number_of(0, 1, false), number_of(1, 2, false), number_of(2, 3, false)}, 1);
  ASSERT_EQ(left.size(), 3u);
  EXPECT_FALSE(left[0].effect);
  EXPECT_EQ(left[1].effect, 0u);
  EXPECT_EQ(left[2].effect, 1u);
  EXPECT_EQ(left[2].index, 3u);
}

TEST(ParameterLists, AParameterIsFoundByEffectIndexAndWhetherItIsAPast) {
  FitParameter past = number_of(0, 1, true);
  past.is_past = true;
  const std::vector<FitParameter> all = {number_of({}, 1, false), number_of(1, 1, false), past, number_of(0, 1, false)};
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(find_parameter(all, all[i]), i);
  EXPECT_FALSE(find_parameter(all, number_of(0, 2, false)));
}

TEST(ParameterLists, AParameterEndsAtABoundThatIsNotItsNeutralValue) {
  FitParameter p = number_of(0, 0, false);
  p.nominal = 0, p.lower = 0, p.upper = 2, p.scale = 0.5;
  EXPECT_FALSE(ends_at_bound(p, 0)) << "it does nothing";
  EXPECT_FALSE(ends_at_bound(p, 1));
  EXPECT_TRUE(ends_at_bound(p, 2));
  EXPECT_TRUE(ends_at_bound(p, 1.999));
  EXPECT_FALSE(ends_at_bound(p, 1.99));
  p.lower = -3;
  EXPECT_TRUE(ends_at_bound(p, -3));
  EXPECT_TRUE(ends_at_bound(p, -2.998));
  EXPECT_FALSE(ends_at_bound(p, -2.9));
  p.natural_bounds = true;
  EXPECT_FALSE(ends_at_bound(p, 2)) << "no other value exists";
  p.natural_bounds = false, p.is_whole = true;
  EXPECT_FALSE(ends_at_bound(p, 2));
  p.is_whole = false, p.effect = {};
  EXPECT_FALSE(ends_at_bound(p, 2)) << "a number of the model";
}

/// The same rule decides whether the search tries wider tolerances, and what the report says of a number.
TEST(ParameterLists, ANumberOfTheModelIsAtItsBoundFrom95PercentOfItsToleranceOn) {
  FitParameter p = number_of({}, 0, false);
  p.nominal = 10, p.lower = 8, p.upper = 12;
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_FALSE(is_at_bound(p, 10 + sign * 1.89));
    EXPECT_TRUE(is_at_bound(p, 10 + sign * 1.91));
    EXPECT_TRUE(is_at_bound(p, 10 + sign * 2));
    EXPECT_FALSE(is_at_limit(p, 10 + sign * 2)) << "the model may be off by more than it states";
  }
  EXPECT_FALSE(is_at_bound(p, 10));
  p.lower = 0.01, p.upper = 20;  // of a friction with a tolerance of 1: it cannot be negative
  EXPECT_TRUE(is_at_limit(p, 0.01));
  EXPECT_FALSE(is_at_limit(p, 0.6)) << "not at the bound";
  EXPECT_TRUE(is_at_bound(p, 20));
  EXPECT_FALSE(is_at_limit(p, 20));
}

TEST(ParameterLists, AParameterOfAnEffectIsAtAPhysicalLimitOnlyIfItsBoundsAreNatural) {
  FitParameter p = number_of(0, 0, false);
  p.nominal = 0, p.lower = 0, p.upper = 2, p.scale = 0.5;
  EXPECT_TRUE(is_at_bound(p, 2));
  EXPECT_FALSE(is_at_limit(p, 2));
  p.natural_bounds = true;
  EXPECT_TRUE(is_at_bound(p, 2));
  EXPECT_TRUE(is_at_limit(p, 2));
  EXPECT_FALSE(is_at_limit(p, 0)) << "it does nothing";
  EXPECT_FALSE(is_at_limit(p, 1));
  p.is_whole = true;
  EXPECT_FALSE(is_at_bound(p, 2));
}

/// One number stands for all lengths of a drive's ratio. Each may be off, and so the ratio by their sum.
TEST(ParameterLists, TheRatioOfADriveMayBeOffByTheTolerancesOfAllItsLengths) {
  ArmModel model = first_joints(3);
  const auto reach_of = [&](const std::string& joint) {
    for (const FitParameter& p : baseline_parameters(model))
      if (p.name.starts_with(joint) && p.name.ends_with("capstan radius")) return (p.upper - p.nominal) / p.nominal;
    return 0.0;
  };
  const double length = model.joints[0].tolerances.length;
  EXPECT_NEAR(reach_of("joint 1"), 3 * length, kRelative);
  EXPECT_NEAR(reach_of("joint 3"), 2 * length, kRelative) << "its cable pulls along the axis";
  model.nominal.joint[0].capstan_radius = model.nominal.joint[0].pulley_radius = 1;
  EXPECT_NEAR(reach_of("joint 1"), length, kRelative) << "a gear";
}

TEST(ParameterLists, NumbersOfTheModelHaveItsTolerances) {
  ArmModel model = first_joints(1);
  model.joints[0].tolerances.friction = 0.2;
  model.joints[0].tolerances.mass = 1.5;
  model.joints[0].tolerances.stiffness = 0;
  bool has_mass = false;
  for (const FitParameter& p : baseline_parameters(model)) {
    EXPECT_FALSE(p.effect);
    EXPECT_TRUE(p.natural_bounds);
    Hypothesis h{model.nominal, {}};
    EXPECT_EQ(parameter_value(h, p), p.nominal) << p.name;
    EXPECT_NEAR(p.scale, (p.upper - p.nominal) / 2, 1e-12 * std::abs(p.scale)) << p.name;
    EXPECT_EQ(p.name.find("gear ratio"), std::string::npos);
    EXPECT_EQ(p.name.find("pulley radius"), std::string::npos);
    EXPECT_EQ(p.name.find("stiffness"), std::string::npos) << "without tolerance";
    if (p.name.find("Coulomb") != std::string::npos) {
      EXPECT_NEAR(p.lower, 0.8 * p.nominal, 1e-12 * p.nominal);
      EXPECT_NEAR(p.upper, 1.2 * p.nominal, 1e-12 * p.nominal);
    }
    if (p.name != "joint 1 link mass") continue;
    has_mass = true;
    EXPECT_NEAR(p.lower, 1e-3 * p.nominal, 1e-12 * p.nominal) << "a mass is positive";
    EXPECT_NEAR(p.upper, 2.5 * p.nominal, 1e-12 * p.nominal);
  }
  EXPECT_TRUE(has_mass);
}

TEST(ParameterLists, AStepGoesInwardAtTheUpperBoundAndIsSmall) {
  const ArmModel model = first_joints(1);
  for (const FitParameter& p : baseline_parameters(model)) {
    Hypothesis h{model.nominal, {}};
    const double step = parameter_value(stepped(h, p), p) - p.nominal;
    EXPECT_GT(step, 0) << p.name;
    EXPECT_LT(step, 0.11 * p.scale) << p.name;
    set_parameter(h, p, p.upper);
    EXPECT_NEAR(parameter_value(stepped(h, p), p) - p.upper, -step, 1e-9 * p.scale) << p.name;
  }
}

TEST(ParameterLists, OfAnEffectAreScaledByTheirTypicalSizeAndPastsByThatOfTheState) {
  const Evidence evidence = small_evidence();
  const ArmModel model = first_joints(2);
  const Hypothesis h{model.nominal, {place_effect(*find_effect("hysteresis"), model.nominal, 1)}};
  const std::vector<FitParameter> all = effect_parameters(evidence, h, model.nominal, 0);
  const PlacedEffect& e = h.effects[0];
  const auto parameters = e.effect->parameters(model.nominal, e.joint);
  const double state = e.effect->state_scale(model.nominal, e.joint, e.p)[0];
  ASSERT_EQ(all.size(), parameters.size() + evidence.records().size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].effect, 0u);
    EXPECT_EQ(all[i].is_past, i >= parameters.size());
    if (all[i].is_past) {
      EXPECT_EQ(all[i].index, i - parameters.size());
      EXPECT_EQ(all[i].scale, state);
      EXPECT_DOUBLE_EQ(all[i].upper, 5 * state);
      EXPECT_DOUBLE_EQ(all[i].lower, -5 * state);
      EXPECT_TRUE(all[i].shape);
      EXPECT_EQ(all[i].name, "past of record " + std::to_string(i - parameters.size() + 1));
    } else if (!all[i].shape) {
      EXPECT_DOUBLE_EQ(all[i].scale, std::max({std::abs(parameters[i].typical - parameters[i].neutral),
                                               0.1 * std::abs(parameters[i].typical),
                                               1e-3 * (parameters[i].upper - parameters[i].lower)}));
      EXPECT_EQ(all[i].lower, parameters[i].lower);
      EXPECT_EQ(all[i].upper, parameters[i].upper);
      EXPECT_EQ(all[i].nominal, parameters[i].neutral);
    }
  }
}

}  // namespace
}  // namespace halyard

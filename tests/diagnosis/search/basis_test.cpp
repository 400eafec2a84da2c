#include "diagnosis/search/basis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/diagnose.h"
#include "diagnosis/search/attribution.h"
#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

TEST(Basis, WidensWhatIsKnown) {
  ArmModel model = first_joints(1);
  Tolerances& stated = model.joints[0].tolerances;
  stated.friction = 0.2;
  stated.torque_scale = 1;
  const Tolerances wide = with_tolerances_times(2, model).joints[0].tolerances;
  EXPECT_EQ(wide.friction, 0.4);
  EXPECT_EQ(wide.torque_scale, 1) << "nothing is known of it";
  model.joints[0].tolerances.torque_scale = 0.5;
  EXPECT_LT(with_tolerances_times(2, model).joints[0].tolerances.torque_scale, 1) << "something is known of it";
  model.joints[0].tolerances.torque_scale = 0.1;
  EXPECT_EQ(with_tolerances_times(2, model).joints[0].tolerances.torque_scale, 0.2);
}

/// Moves each number of the model by so many tolerances, up and down in turns.
void move_numbers(ArmModel& robot, double tolerances) {
  Hypothesis h{robot.nominal, {}};
  double sign = 1;
  for (const FitParameter& p : baseline_parameters(robot))
    set_parameter(h, p, p.nominal + (sign = -sign) * tolerances * (p.upper - p.nominal));
  robot.nominal = h.nominal;
}

/// One name for each number that is off would be a patchwork.
TEST(Basis, AModelThatIsOffByMoreThanItStatesGetsWiderTolerancesAndNoNames) {
  const ArmModel model = first_joints(1);
  ArmModel robot = model;
  move_numbers(robot, 1.8);
  DiagnosisOptions options;
  options.tell_not_excited = false;
  const Diagnosis d =
      diagnose(model, {simulate(motion(robot, 12)).measured}, simulate(motion(robot, 12, 1)).measured, options);
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::clean);
  EXPECT_TRUE(d.effects.empty());
  EXPECT_FALSE(d.refitted.empty());
  EXPECT_EQ(d.tolerance_factor, 2);
  EXPECT_EQ(d.revised.joints[0].tolerances.friction, model.joints[0].tolerances.friction) << "the model's own stay";
}

TEST(Basis, OneNumberThatIsOffIsAnEffect) {
  const ArmModel model = first_joints(1);
  ArmModel robot = model;
  robot.nominal.joint[0].motor_coulomb *= 1.8;
  const Evidence evidence(make_records(simulate(motion(robot, 12)).measured, model, {}), model);
  const Attribution a = attribute(evidence, model, {}, {});
  EXPECT_EQ(a.tolerance_factor, 1);
  ASSERT_EQ(a.final_fit.hypothesis.effects.size(), 1u);
  EXPECT_EQ(a.final_fit.hypothesis.effects[0].effect->name(), "motor_friction");
}

TEST(Basis, IsNarrowIfTwoNumbersArePressedAgainstTheirTolerancesOrReplaced) {
  const ArmModel model = first_joints(1);
  const Basis basis(made_evidence(), model, 1, 0);
  const PlacedEffect ratio = place_effect(*find_effect("capstan_ratio"), model.nominal, 0);
  const std::vector<FitParameter> others = basis.refitter.numbers_beside({model.nominal, {ratio}});
  ASSERT_GE(others.size(), 2u);
  ASSERT_LT(others.size(), basis.refitter.numbers().size()) << "it replaces one";
  const auto is_narrow = [&](double first, double second, const std::vector<PlacedEffect>& effects = {}) {
    Hypothesis h{model.nominal, effects};
    for (const auto& [p, share] : {std::pair(others[0], first), std::pair(others[1], second)})
      set_parameter(h, p, p.nominal + share * (share > 0 ? p.upper - p.nominal : p.nominal - p.lower));
    return basis.is_narrow(h);
  };
  EXPECT_FALSE(is_narrow(0, 0));
  EXPECT_TRUE(is_narrow(0.96, 0.96));
  EXPECT_TRUE(is_narrow(-0.96, 0.96));
  EXPECT_FALSE(is_narrow(0.96, 0.94));
  EXPECT_FALSE(is_narrow(-0.94, 0.96));
  EXPECT_FALSE(is_narrow(0, 0, {ratio}));
  EXPECT_TRUE(is_narrow(0, -0.96, {ratio}));
}

TEST(Basis, WiderTolerancesAndAddedNamesHaveTheirCosts) {
  ArmModel exact = first_joints(1);  // whose numbers cannot be off, so that they cost nothing
  exact.joints[0].tolerances = {0, 0, 0, 0, 0, 0, 0, 0, 0};
  const PlacedEffect zero = place_effect(*find_effect("encoder_offset"), exact.nominal, 0);
  const auto cost = [&](double factor, const std::vector<PlacedEffect>& given, const std::vector<PlacedEffect>& all) {
    ArmModel model = exact;
    model.effects = given;
    Found found;
    found.fit.hypothesis = {model.nominal, all};
    found.score = made_evidence().score(found.fit.hypothesis);
    return Basis(made_evidence(), model, factor, given.size()).prior_cost(found);
  };
  EXPECT_NEAR(cost(1, {}, {}), 0, 1e-12);
  EXPECT_NEAR(cost(4, {}, {}), 2 * kRule.cost_of_wider_tolerances, 1e-12) << "for each doubling";
  const double name = prior_cost_of(zero, exact.nominal),
               choice = std::log(static_cast<double>(all_candidates(exact.nominal).size()));
  EXPECT_NEAR(cost(1, {}, {zero}), name + choice, 1e-12);
  EXPECT_NEAR(cost(2, {zero}, {zero, zero}), kRule.cost_of_wider_tolerances + name + choice, 1e-12)
      << "the model came with the first";
}

}  // namespace
}  // namespace halyard

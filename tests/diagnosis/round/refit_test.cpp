/// Which parameters a refit fits, and where it starts.

#include "diagnosis/round/refit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/judgement/final_fit.h"
#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

PlacedEffect at_the_joint(const char* name) { return place_effect(*find_effect(name), first_joints(1).nominal, 0); }

bool is_radius(const FitParameter& p) { return p.name.ends_with("capstan radius"); }

TEST(Refitter, FitsTheNumbersThatNoAddedEffectReplaces) {
  const ArmModel model = first_joints(1);
  ArmModel with_ratio = model;
  with_ratio.effects = {at_the_joint("capstan_ratio")};
  const Hypothesis h{model.nominal, with_ratio.effects};
  const Refitter added(made_evidence(), model, 0), given(made_evidence(), with_ratio, 1);
  ASSERT_TRUE(added.is_usable() && given.is_usable());
  ASSERT_EQ(std::ranges::count_if(added.numbers(), is_radius), 1);
  ASSERT_GT(added.numbers().size(), 2u);
  EXPECT_EQ(added.numbers_beside(h).size(), added.numbers().size() - 1);
  EXPECT_EQ(std::ranges::count_if(added.numbers_beside(h), is_radius), 0);
  EXPECT_EQ(given.numbers_beside(h).size(), given.numbers().size()) << "the model came with it";
}

TEST(Refitter, FitsTheDampingOfACableBesideAnEffectThatLetsItYield) {
  const ArmModel model = first_joints(1);
  const Refitter refitter(made_evidence(), model, 0);
  const auto fits_damping = [&](const Hypothesis& h) {
    return std::ranges::any_of(refitter.numbers_beside(h),
                               [](const FitParameter& p) { return p.name == "joint 1 cable damping"; });
  };
  Hypothesis h{model.nominal, {}};
  EXPECT_FALSE(fits_damping(h)) << "the log is not sensitive to it";
  EXPECT_FALSE(fits_damping({model.nominal, {at_the_joint("motor_friction")}}));
  EXPECT_FALSE(fits_damping({model.nominal, {at_the_joint("stiffness")}})) << "this effect replaces it";
  EXPECT_TRUE(fits_damping({model.nominal, {at_the_joint("hysteresis")}}));
  h.nominal.joint[0].damping *= 1.01;
  EXPECT_TRUE(fits_damping(h)) << "what is off can return";
}

TEST(Refitter, FitsOfAGivenEffectItsPastAlone) {
  const ArmModel model = first_joints(1);
  ArmModel with_loop = model;
  with_loop.effects = {at_the_joint("hysteresis")};
  const Hypothesis h{model.nominal, with_loop.effects};
  const auto of_the_loop = [&](const Refitter& refitter) {
    std::vector<std::string> names;
    for (const FitParameter& p : refitter.parameters(h))
      if (p.effect) names.push_back(p.name);
    return names;
  };
  EXPECT_EQ(of_the_loop(Refitter(made_evidence(), model, 0)),
            (std::vector<std::string>{"share", "yield_stretch", "past of record 1"}));
  EXPECT_EQ(of_the_loop(Refitter(made_evidence(), with_loop, 1)), std::vector<std::string>{"past of record 1"});
}

TEST(Refitter, ResetsTheNumbersThatANewEffectReplaces) {
  const ArmModel model = first_joints(1);
  const Refitter refitter(made_evidence(), model, 0);
  Hypothesis h{model.nominal, {}};
  h.nominal.joint[0].capstan_radius *= 1.01;
  h.nominal.joint[0].mass *= 1.02;
  const Hypothesis ratio = refitter.with_effect(h, at_the_joint("capstan_ratio"));
  ASSERT_EQ(ratio.effects.size(), 1u);
  EXPECT_EQ(ratio.nominal.joint[0].capstan_radius, model.nominal.joint[0].capstan_radius);
  EXPECT_EQ(ratio.nominal.joint[0].mass, h.nominal.joint[0].mass);
  constexpr double kPast = 3e-6;  // m
  const Hypothesis loop = refitter.with_effect(ratio, at_the_joint("hysteresis"), {kPast});
  ASSERT_EQ(loop.effects.size(), 2u);
  EXPECT_EQ(loop.past_state(1, 0), kPast);
  EXPECT_EQ(loop.past_state(0, 0), 0);
}

TEST(Refitter, OfWhatCannotBeIntegratedHasNoResult) {
  const ArmModel model = first_joints(1);
  const Refitter refitter(made_evidence(), model, 0);
  const Hypothesis right{model.nominal, {}};
  Hypothesis wrong = right;
  wrong.nominal.joint[0].mass = std::nan("");
  EXPECT_FALSE(refitter.refitted(wrong, made_evidence().score(right)));
}

TEST(Refit, FromAnotherStartKnowsNothingOfTheFirst) {
  Refit first{{first_joints(1).nominal, {}}, {}};
  first.best.usable = first.settled = true;
  first.last = 3;
  first.held.resize(1);
  first.nudged_from = 2;
  Hypothesis other = first.at;
  other.nominal.joint[0].mass = 7;
  const Refit again = restarted(first, other);
  EXPECT_EQ(again.at.nominal.joint[0].mass, 7);
  EXPECT_FALSE(again.best.usable);
  EXPECT_EQ(again.last, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(again.settled);
  EXPECT_FALSE(again.is_nudged);
  EXPECT_EQ(again.held.size(), 1u) << "what is held stays held";
  EXPECT_EQ(again.nudged_from, 2u);
}

TEST(FinalFit, HasEachNumberOfTheModelThatNoEffectCovers) {
  const ArmModel model = first_joints(1);
  PlacedEffect softer = place_neutral_effect(*find_effect("stiffness"), model.nominal, 0);
  softer.p[0] = 0.8;
  ArmModel robot = model;
  robot.effects = {softer};
  const std::vector<Record> records = make_records(simulate(motion(robot, 5)).measured, model, {});
  const Evidence evidence(records, model), whole(records, model, Split::none);
  const Hypothesis h{model.nominal, {softer}};
  const Fit fit = final_fit(whole, model, Refitter(evidence, model, 0).refit(h, evidence.score(h)), 0);
  int covered = 0;
  for (const FitParameter& number : baseline_parameters(model)) {
    const bool is_covered = effect_covers(softer, model.nominal, number);
    EXPECT_EQ(find_parameter(fit.parameters, number).has_value(), !is_covered) << number.name;
    covered += is_covered;
  }
  EXPECT_GT(covered, 0);
}

}  // namespace
}  // namespace halyard

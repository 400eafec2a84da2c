#include "diagnosis/round/joint_proposal.h"

#include <gtest/gtest.h>

#include "diagnosis/round/candidate_round.h"
#include "diagnosis/search/attribution.h"
#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

PlacedEffect of_first_joint(const std::string& name, const ArmModel& model, double size) {
  PlacedEffect e = place_neutral_effect(*find_effect(name), model.nominal, 0);
  e.p[0] = size;
  return e;
}

/// Two joints in motion. The drive of the first is faster than the model's, if at all, and its encoder was set to zero
/// in the middle of the motion: ratio and offset cancel there. What is left is the ratio times the distance from the
/// middle, of which the offset explains nothing and the ratio 5 %, since the joint is always far from zero.
Evidence recorded(const ArmModel& model, double ratio) {
  ArmModel robot = model;
  if (ratio != 1)
    robot.effects = {of_first_joint("capstan_ratio", model, ratio),
                     of_first_joint("encoder_offset", model, (ratio - 1) * model.joints[0].home)};
  return Evidence(make_records(simulate(motion(robot, 6)).measured, model, {}), model);
}

TEST(JointProposal, FindsTwoEffectsThatEachExplainLittleAlone) {
  const ArmModel model = first_joints(2);
  const Attribution a = attribute(recorded(model, 1.06), model, {}, {});
  const auto at_once = std::ranges::find_if(a.rounds, &Round::at_once);
  ASSERT_NE(at_once, a.rounds.end());
  EXPECT_TRUE(at_once->accepted);
  for (auto round = a.rounds.begin(); round != at_once; ++round) {
    if (round->trials.empty()) continue;  // the tolerances were widened
    const std::string first = round->trials[0].effect.effect->name();
    EXPECT_FALSE(round->accepted && (first == "capstan_ratio" || first == "encoder_offset"))
        << first << " was named alone: the test shows nothing";
  }
  const std::vector<PlacedEffect>& found = a.final_fit.hypothesis.effects;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].effect->name(), "capstan_ratio");
  EXPECT_EQ(found[1].effect->name(), "encoder_offset");
  // A count of the joint's encoder over the range of the motion is 8e-5 / 0.8 = 1e-4.
  EXPECT_NEAR(found[0].p[0], 1.06, 2e-4);
  EXPECT_NEAR(found[1].p[0], 0.06 * model.joints[0].home, 2e-4);
  // Both have competed for their names since.
  for (const Naming& naming : a.namings) EXPECT_GT(naming.weight, 0.5);
}

TEST(JointProposal, OfAnArmWithoutEffectsProposesNothing) {
  const ArmModel model = first_joints(2);
  const Evidence evidence = recorded(model, 1);
  const Refitter refitter(evidence, model, 0);
  const Hypothesis nominal{model.nominal, {}};
  const Fit baseline = refitter.refit(nominal, evidence.score(nominal));
  const Scored without{baseline.hypothesis, evidence.score(baseline.hypothesis)};
  const Judge judge(evidence, model, refitter.numbers());
  const SearchProgress quiet = [](const std::string&, double) {};
  CandidateRound round(evidence, model, refitter, judge, without, nominal, "a round", quiet);
  round.look(all_candidates(model.nominal));
  ASSERT_EQ(round.linear().starts.size(), all_candidates(model.nominal).size());
  const JointSearch search(evidence, refitter, judge, 0);
  EXPECT_FALSE(search.propose(round.linear(), without, 0.01, 6).is_convincing);
}

/// The zero of the joint is off, and the round starts where the ratio of the drive is at the end of its tolerance.
TEST(JointSelection, TakesBackWhatANumberIsOffBesideTheEffectThatItSelects) {
  const ArmModel model = first_joints(1);
  constexpr double kZero = 0.1;  // rad
  Log log = log_along(4, 100, slow_swing);
  for (double& q : log.joint_position[0]) q -= kZero;
  const Evidence evidence(make_records(log, model, {}), model);
  const Refitter refitter(evidence, model, 0);
  const Judge judge(evidence, model, refitter.numbers());
  LinearRound round;
  round.from = {model.nominal, {}};
  round.numbers = baseline_parameters(model);
  std::erase_if(round.numbers, [](const FitParameter& p) { return !p.name.ends_with("capstan radius"); });
  ASSERT_EQ(round.numbers.size(), 1u);
  const FitParameter& radius = round.numbers[0];
  set_parameter(round.from, radius, radius.upper);
  round.columns = sensitivities(evidence, round.from, round.numbers);
  const Screen screen(evidence, round.from, round.columns,
                      channel_scale(evidence, evidence.score(round.from).fit_mean_square));
  const PlacedEffect zero = place_effect(*find_effect("encoder_offset"), model.nominal, 0);
  round.starts = {best_start(evidence, screen, {round.from.nominal, {zero}}, model.nominal)};
  const JointSearch search(evidence, refitter, judge, 0);
  const Hypothesis h = search.select(round, 6);
  ASSERT_EQ(h.effects.size(), 1u);
  EXPECT_EQ(h.effects[0].effect->name(), "encoder_offset");
  EXPECT_NEAR(h.effects[0].p[0], kZero, 3e-3) << "the cable's stretch is 2e-4";
  EXPECT_NEAR(parameter_value(h, radius), radius.nominal, 0.1 * (radius.upper - radius.nominal));
  EXPECT_TRUE(search.select(round, 0).effects.empty()) << "none may be added";
}

}  // namespace
}  // namespace halyard

#include "diagnosis/rehearse.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

PlacedEffect placed(const std::string& effect, EffectPlace joint) { return {find_effect(effect), joint}; }

/// Of an arm with two effects, one of them too small to be seen: one right name and one false.
RehearsedLog half_right() {
  RehearsedLog log;
  log.truth = RehearsedTruth::drawn;
  log.hidden = {{placed("backlash", 0), true, true}, {placed("creep", 1), false, false}};
  log.names = {{placed("backlash", 0), 0.97, true}, {placed("stiffness", 1), 0.485, false}};
  log.verdict = Diagnosis::Verdict::effects;
  return log;
}

RehearsedLog without_effect(Diagnosis::Verdict verdict) {
  RehearsedLog log;
  log.verdict = verdict;
  return log;
}

TEST(Rehearsal, CountsWhatWasNamedAndWhatWasFalse) {
  RehearsedLog failed = half_right();
  failed.names.clear();
  failed.hidden[0].is_named = false;
  failed.failure = "no";
  const Rehearsal r{1, {half_right(), failed, without_effect(Diagnosis::Verdict::clean)}};
  const RehearsalCount drawn = r.count(RehearsedTruth::drawn);
  EXPECT_EQ(drawn.logs, 2);
  EXPECT_EQ(drawn.right, 0) << "a false name, and a failure";
  EXPECT_EQ(drawn.failed, 1);
  EXPECT_EQ(drawn.visible, 2);
  EXPECT_EQ(drawn.named, 1);
  EXPECT_EQ(drawn.too_small, 2);
  EXPECT_EQ(drawn.names, 2);
  EXPECT_EQ(drawn.false_names, 1);
  EXPECT_EQ(r.count(RehearsedTruth::found).logs, 0);
}

TEST(RehearsedDiagnosis, IsRightIfAllThatIsVisibleIsNamedAndNothingElse) {
  RehearsedLog log = half_right();
  EXPECT_FALSE(log.is_right()) << "a false name";
  log.names.pop_back();
  EXPECT_TRUE(log.is_right()) << "the other effect is too small to be seen";
  log.hidden[1].is_visible = true;
  EXPECT_FALSE(log.is_right());
  EXPECT_TRUE(without_effect(Diagnosis::Verdict::clean).is_right());
  EXPECT_FALSE(without_effect(Diagnosis::Verdict::unknown).is_right());
}

TEST(Rehearsal, MovesTheShareThatCameTrueByWhatItHasSeen) {
  EXPECT_NEAR(Rehearsal{}.right_if_certain(), 0.97, 1e-12) << "DecisionRule::right_if_certain";
  // Names for which the evidence had 1 and 0.5: one of them right.
  EXPECT_NEAR((Rehearsal{1, {half_right()}}.right_if_certain()), (0.97 * 20 + 1) / (20 + 1.5), 1e-12);
  RehearsedLog as_found = half_right();
  as_found.truth = RehearsedTruth::found;
  EXPECT_NEAR((Rehearsal{1, {as_found}}.right_if_certain()), 0.97, 1e-12) << "these names come from the log itself";
  const Rehearsal good{1, std::vector<RehearsedLog>(100, [] {
                         RehearsedLog log = half_right();
                         log.names[0].probability = 0.5;
                         log.names.pop_back();
                         return log;
                       }())};
  EXPECT_EQ(good.right_if_certain(), 1) << "no more than certain";
  EXPECT_NEAR(good.calibrated(0.485), 0.5, 1e-12);
}

TEST(Rehearse, FindsAgainWhatWasFoundThenNothingWhereNothingIsThenDrawsAnEffect) {
  const ArmModel model = first_joints(2);
  ArmModel robot = model;
  robot.effects.push_back(place_effect(*find_effect("backlash"), model.nominal, 1));
  const std::vector<Log> training = {simulate(motion(robot, 8)).measured};
  const Log holdout = simulate(motion(robot, 3, 1)).measured;
  DiagnosisOptions quick;
  quick.most_effects = 1;
  const Diagnosis d = diagnose(model, training, holdout, quick);
  const Rehearsal r = rehearse(model, d, training, holdout, {3, 3}, quick);
  ASSERT_EQ(r.logs.size(), 3u);
  EXPECT_EQ(r.logs[0].truth, RehearsedTruth::found);
  ASSERT_EQ(r.logs[0].hidden.size(), 1u);
  EXPECT_EQ(effect_label(r.logs[0].hidden[0].effect), "backlash of joint 2");
  EXPECT_TRUE(r.logs[0].is_right()) << r.logs[0].failure;
  EXPECT_EQ(r.logs[1].truth, RehearsedTruth::nothing);
  EXPECT_TRUE(r.logs[1].hidden.empty());
  EXPECT_TRUE(r.logs[1].is_right()) << r.logs[1].failure;
  EXPECT_EQ(r.logs[2].truth, RehearsedTruth::drawn);
  EXPECT_EQ(r.logs[2].hidden.size(), 1u) << "as many as were found";
}

}  // namespace
}  // namespace halyard

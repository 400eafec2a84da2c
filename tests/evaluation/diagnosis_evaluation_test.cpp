#include "evaluation/studies/diagnosis_evaluation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "diagnosis/diagnosis_details.h"
#include "evaluation/studies/diagnosis_evidence.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

TEST(AlternativesSentence, NamesThoseAloneThatAreInTheSet) {
  const ArmParameters<double> arm = first_joints(2).nominal;
  const auto effect = [&](const char* name) { return place_effect(*find_effect(name), arm, 1); };
  NamedEffect named;
  named.effect = effect("hysteresis");
  named.alternatives = {{effect("creep"), 0.3, true}, {effect("stiffness"), 0.2, true}, {effect("slack"), 0, false}};
  EXPECT_EQ(alternatives_sentence(named), " These data cannot tell it from creep of joint 2, stiffness of joint 2.");
  named.alternatives = {{effect("slack"), 0, false}};
  EXPECT_EQ(alternatives_sentence(named), "") << "as good as excluded";
}

/// A diagnosis of one joint that has added these effects and named the last one, and the logs of an arm that has them.
struct LastIsNamed {
  ArmModel model = first_joints(1), robot = model;
  std::vector<Log> training;
  Log holdout;
  DiagnosisDetails details;

  explicit LastIsNamed(const std::vector<std::pair<const char*, std::vector<double>>>& added) {
    for (const auto& [name, p] : added) {
      PlacedEffect e = place_neutral_effect(*find_effect(name), model.nominal, 0);
      std::ranges::copy(p, e.p);
      robot.effects.push_back(e);
    }
    details.attribution.final_fit.hypothesis = {robot.nominal, robot.effects, {}};
  }
  void record(const ArmModel& arm, double clock_shift, const RecordOptions& options = {}) {
    training.push_back(simulate(motion(arm, 3)).measured);
    holdout = training.back();
    holdout.joint_position[0].clear();  // no estimators, for the time that they take
    for (Record& r : make_records(training.back(), model, options)) {
      r.clock_shift = clock_shift;
      r.place = static_cast<int>(details.training.size());
      details.training.push_back(std::move(r));
    }
  }
  DiagnosisEvaluation evaluated() const {
    Diagnosis d;
    d.given = model;
    d.revised = robot;
    d.effects.push_back({.effect = robot.effects.back(), .probability = 1, .parameters = {}, .alternatives = {}});
    d.effects[0].index = robot.effects.size() - 1;
    d.details = std::make_shared<DiagnosisDetails>(details);
    return evaluate_diagnosis(model, d, training, holdout);
  }
};

TEST(Evidence, OfANamedEffectIsNotThatOfTheUnnamedOneBeforeIt) {
  LastIsNamed s({{"encoder_offset", {0.02}}, {"motor_friction", {0.02}}});
  s.record(s.robot, 0);
  const DiagnosisEvaluation e = s.evaluated();
  ASSERT_EQ(e.why.size(), 1u);
  EXPECT_TRUE(e.why[0].starts_with("Without it the motor torque residual of joint 1 ")) << e.why[0];
  const EffectEvidence& of_friction = e.evidence->effects[0];
  const std::vector<double>&without = of_friction.without.of(ResidualKind::joint_position),
        &with = of_friction.with.of(ResidualKind::joint_position);
  ASSERT_FALSE(with.empty());
  double most = 0;
  for (std::size_t i = 0; i < with.size(); ++i)
    if (std::isfinite(with[i])) most = std::max(most, std::abs(without[i] - with[i]));
  EXPECT_LT(most, 1e-3) << "the zero error stays";
}

TEST(Evidence, OfAPushIsTheLogInWhichItHappens) {
  constexpr double kLater = 4;  // s
  LastIsNamed s({{"external_force", {2.0, 1.0 + kLater, 2.0 + kLater}}});
  s.record(s.model, 0);
  s.robot.effects[0].p[1] -= kLater, s.robot.effects[0].p[2] -= kLater;
  s.record(s.robot, kLater);
  const DiagnosisEvaluation e = s.evaluated();
  EXPECT_TRUE(e.why[0].ends_with("less than 0.1 % of the mean square is left.")) << e.why[0];
  EXPECT_TRUE(std::ranges::is_sorted(e.evidence->effects[0].with.time)) << "one log after the other";
}

TEST(Evidence, ComparesWhatTheDiagnosisHasCompared) {
  LastIsNamed s({{"motor_friction", {0.02}}});
  s.record(s.robot, 0);
  const auto samples = [&] { return s.evaluated().evidence->effects[0].with.time.size(); };
  const std::size_t all = samples();
  Record& r = s.details.training[0];
  r.start += 0.1;  // as of other records than the log's
  EXPECT_EQ(samples(), all);
  EXPECT_NEAR(s.evaluated().evidence->effects[0].with.time[0], r.start, 1e-9);
}

}  // namespace
}  // namespace halyard

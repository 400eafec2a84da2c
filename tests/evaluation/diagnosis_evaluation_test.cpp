#include "evaluation/studies/diagnosis_evaluation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

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

/// A diagnosis that has added a zero error without a name and then named a friction.
struct NamedBesideAnUnnamedOne {
  ArmModel model = first_joints(1);
  Diagnosis diagnosis;
  Log training, holdout;

  NamedBesideAnUnnamedOne() {
    ArmModel robot = model;
    const auto added = [&](const char* name, double size) {
      PlacedEffect e = place_neutral_effect(*find_effect(name), model.nominal, 0);
      e.p[0] = size;
      robot.effects.push_back(e);
    };
    added("encoder_offset", 0.02), added("motor_friction", 0.02);
    training = simulate(motion(robot, 3)).measured;
    holdout = training;
    holdout.joint_position[0].clear();  // no estimators, for the time that they take
    diagnosis.given = model;
    diagnosis.revised = robot;
    diagnosis.effects.push_back({.effect = robot.effects[1], .probability = 1, .parameters = {}, .alternatives = {}});
    diagnosis.effects[0].index = 1;
    diagnosis.details = std::make_shared<DiagnosisDetails>();
  }
};

TEST(Evidence, OfANamedEffectIsNotThatOfTheUnnamedOneBeforeIt) {
  const NamedBesideAnUnnamedOne s;
  const DiagnosisEvaluation e = evaluate_diagnosis(s.model, s.diagnosis, {s.training}, s.holdout);
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

}  // namespace
}  // namespace halyard

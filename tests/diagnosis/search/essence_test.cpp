#include "diagnosis/search/essence.h"

#include <gtest/gtest.h>

#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

/// Friction of motor and joint that rises to this factor at once, and then by this rate, 1/s.
PlacedEffect drifting_friction(double rate, double factor) {
  PlacedEffect e = place_neutral_effect(*find_effect("friction_drift"), first_joints(1).nominal, 0);
  e.p[0] = rate, e.p[1] = factor;
  return e;
}

/// Whether a drift that is fitted to the log of an arm with `truth` needs no drift.
bool needs_no_drift(const PlacedEffect& truth) {
  const ArmModel model = first_joints(1);
  ArmModel robot = model;
  robot.effects = {truth};
  const Evidence evidence(make_records(simulate(motion(robot, 6)).measured, model, {}), model);
  const Refitter refitter(evidence, model, 0);
  const Judge judge(evidence, model, refitter.numbers());
  const Hypothesis start{model.nominal, {drifting_friction(0.01, 1.5)}};
  const Hypothesis fitted = refitter.refit(start, evidence.score(start)).hypothesis;
  return is_another_effect(evidence, refitter, judge, {fitted, evidence.score(fitted)}, 0);
}

TEST(Essence, OfADriftIsThatItDrifts) {
  EXPECT_TRUE(needs_no_drift(drifting_friction(0, 1.6)));
  EXPECT_FALSE(needs_no_drift(drifting_friction(0.08, 1.2)));
}

}  // namespace
}  // namespace halyard

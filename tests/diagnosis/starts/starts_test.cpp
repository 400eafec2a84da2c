#include "diagnosis/starts/starts.h"

#include <gtest/gtest.h>

#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

/// Where the fit of a hysteresis begins on the log of an arm that has one.
Start start_of_a_hysteresis(double share, double yield_stretch) {
  const ArmModel model = first_joints(1);
  const PlacedEffect candidate = place_effect(*find_effect("hysteresis"), model.nominal, 0);
  ArmModel robot = model;
  robot.effects = {candidate};
  robot.effects[0].p[0] = share, robot.effects[0].p[1] = yield_stretch;
  const Evidence evidence(make_records(simulate(motion(robot, 5)).measured, model, {}), model);
  const Hypothesis nominal{model.nominal, {}};
  const Screen screen(evidence, nominal, {}, std::vector<double>(evidence.channels(), 1e-6));
  return best_start(evidence, screen, {model.nominal, {candidate}}, model.nominal);
}

TEST(BestStart, HasOtherShapesInEachHypothesis) {
  const Start start = start_of_a_hysteresis(0.4, 2e-5);
  ASSERT_GT(start.hypotheses.size(), 1u);
  for (std::size_t i = 0; i < start.hypotheses.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(start.hypotheses[i].effects[0].p[1], start.hypotheses[j].effects[0].p[1])
          << "they differ only in the cable's past";
}

TEST(BestStart, OfACableThatNearlyYieldsAsAWholeHasNearlyTheWholeShare) {
  EXPECT_GT(start_of_a_hysteresis(0.9, 3e-6).hypotheses.at(0).effects[0].p[0], 0.8);
}

}  // namespace
}  // namespace halyard

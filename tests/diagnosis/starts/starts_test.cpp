#include "diagnosis/starts/starts.h"

#include <gtest/gtest.h>

#include "diagnosis/round/refit.h"
#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

/// The log of an arm whose last cable has a hysteresis, and where the fit of one begins.
struct Looped {
  ArmModel model;
  PlacedEffect candidate;
  Evidence evidence;
  Hypothesis from;
  Screen screen;
  Start start;

  Looped(int joints, double share, double yield_stretch)
      : model(first_joints(joints)),
        candidate(place_effect(*find_effect("hysteresis"), model.nominal, joints - 1)),
        evidence(make_records(simulate(motion(robot(share, yield_stretch), 5)).measured, model, {}), model),
        from{model.nominal, {}},
        screen(evidence, from, sensitivities(evidence, from, Refitter(evidence, model, 0).numbers()),
               channel_scale(evidence, evidence.score(from).fit_mean_square)),
        start(best_start(evidence, screen, {model.nominal, {candidate}}, model.nominal)) {}

  ArmModel robot(double share, double yield_stretch) const {
    ArmModel arm = model;
    arm.effects = {candidate};
    arm.effects[0].p[0] = share, arm.effects[0].p[1] = yield_stretch;
    return arm;
  }
};

TEST(BestStart, HasOtherShapesInEachHypothesis) {
  const Start start = Looped(1, 0.4, 2e-5).start;
  ASSERT_GT(start.hypotheses.size(), 1u);
  for (std::size_t i = 0; i < start.hypotheses.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(start.hypotheses[i].effects[0].p[1], start.hypotheses[j].effects[0].p[1])
          << "they differ only in the cable's past";
}

TEST(BestStart, OfACableThatNearlyYieldsAsAWholeHasNearlyTheWholeShare) {
  EXPECT_GT(Looped(1, 0.9, 3e-6).start.hypotheses.at(0).effects[0].p[0], 0.8);
}

/// The typical size is far beyond what is linear, and tells less.
TEST(BestStart, PromisesWhatTheSizeOfTheLinearFitTells) {
  const Looped l(2, 0.1, 2e-6);
  const Hypothesis& best = l.start.hypotheses.at(0);
  ASSERT_LT(best.effects[0].p[0], 0.3) << "it is the typical size: the test shows nothing";
  EXPECT_GE(l.start.promise, l.screen.direction(l.evidence.fit_rows({best})[0]).promise);
}

TEST(Screen, AsksForTheMultipleOfAChangeThatLeavesNothing) {
  const Evidence& evidence = made_evidence();
  const Hypothesis at{first_joints(1).nominal, {}};
  const Screen screen(evidence, at, {}, std::vector<double>(2, 1.0));
  const std::vector<double> residual = evidence.fit_rows({at})[0];
  for (const double left : {0.0, 0.5, 3.0}) {
    std::vector<double> rows = residual;
    for (double& r : rows) r *= left;
    const Screen::Direction d = screen.direction(rows);
    EXPECT_NEAR(d.promise, 1, 1e-9) << left;
    EXPECT_NEAR(d.amount, 1 / (1 - left), 1e-9) << left;
  }
  std::vector<double> beside = residual;
  beside[0] += residual[1], beside[1] -= residual[0];
  EXPECT_NEAR(screen.direction(beside).promise, 0, 1e-9) << "it has nothing in common with the residual";
  EXPECT_EQ(screen.direction({}).promise, 0);
}

}  // namespace
}  // namespace halyard

#include "diagnosis/starts/starts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

/// Where the fit of a candidate begins on a log that is made by hand, of which only the joint's sensor is compared.
struct MadeStart {
  ArmModel model = first_joints(1);
  PlacedEffect candidate;
  Evidence evidence;
  Hypothesis from;
  Screen screen;
  Start start;

  /// reading(t): of the joint's sensor, while its motor follows the slow swing.
  template <class Reading>
  MadeStart(const char* name, const Reading& reading, double duration = 4)
      : candidate(place_effect(*find_effect(name), model.nominal, 0)),
        evidence(make_records(log_with(reading, duration), model, {}), model),
        from{model.nominal, {}},
        screen(evidence, from, {}, std::vector<double>(2, 1.0)),
        start(best_start(evidence, screen, {model.nominal, {candidate}}, model.nominal)) {}

  template <class Reading>
  static Log log_with(const Reading& reading, double duration) {
    Log log = log_along(duration, 100, slow_swing);
    for (std::size_t i = 0; i < log.size(); ++i) log.joint_position[0][i] = reading(log.time[i]);
    return log;
  }
  double left_at(const Hypothesis& h) const { return screen.left(evidence.fit_rows({h})[0]); }
};

TEST(BestStart, HasTheSizeThatTheLinearFitAsksForAsFarAsItsBound) {
  const MadeStart ratio("capstan_ratio", [](double t) { return 1.3 * slow_swing(t); });
  ASSERT_EQ(ratio.start.hypotheses.size(), 1u) << "it has no shapes";
  // What the cable stretches under the joint's weight is a ten-thousandth of a radian.
  EXPECT_NEAR(ratio.start.hypotheses[0].effects.at(0).p[0], 1.3, 2e-3);
  EXPECT_GT(ratio.start.promise, 0.999);
  EXPECT_LT(ratio.start.left, 1e-4 * ratio.left_at(ratio.from));
  const MadeStart zero("encoder_offset", [](double t) { return slow_swing(t) + 0.7; });
  ASSERT_EQ(zero.start.hypotheses.size(), 1u);
  EXPECT_EQ(zero.start.hypotheses[0].effects.at(0).p[0], -0.5) << "rad; the sensor is above the motor's encoder";
}

TEST(BestStart, TellsTheChangeByAUnitOfASize) {
  const MadeStart ratio("capstan_ratio", [](double t) { return 1.3 * slow_swing(t); });
  ASSERT_EQ(ratio.start.directions.size(), 1u);
  const Directions& d = ratio.start.directions[0];
  EXPECT_EQ(d.neutral.effects.at(0).p[0], 1);
  EXPECT_EQ(d.numbers, 1u);
  ASSERT_EQ(d.sizes.size(), 1u);
  ASSERT_EQ(d.columns.size(), 1u);
  const std::vector<double>& time = ratio.evidence.row_time();
  ASSERT_EQ(d.columns[0].size(), time.size());
  for (std::size_t r = 0; r < time.size(); ++r)
    EXPECT_NEAR(d.columns[0][r], -d.sizes[0].scale * slow_swing(time[r]), 1e-3) << time[r];
}

TEST(BestStart, OfASlipIsWhereTheResidualLeaps) {
  constexpr double kTime = 2.613, kStep = 0.01;  // s, amid a fitting block; rad
  const MadeStart slip("cable_slip", [&](double t) { return slow_swing(t) + (t > kTime ? kStep : 0.0); });
  ASSERT_EQ(slip.start.hypotheses.size(), 3u);
  const double* p = slip.start.hypotheses[0].effects.at(0).p;
  const double jump = -kStep * slip.model.nominal.joint[0].pulley_radius;
  EXPECT_NEAR(p[0], jump, 0.05 * std::abs(jump)) << "the cable's stretch is a fiftieth of it";
  EXPECT_NEAR(p[1], kTime, 0.015) << "a row is 0.02 s";
  EXPECT_EQ(p[2], 0) << "at once";
  for (std::size_t i = 1; i < 3; ++i) {
    const Hypothesis &better = slip.start.hypotheses[i - 1], &worse = slip.start.hypotheses[i];
    EXPECT_LE(slip.left_at(better), 1.02 * slip.left_at(worse)) << "that which leaves least comes first";
    EXPECT_TRUE(better.effects[0].p[1] != worse.effects[0].p[1] || better.effects[0].p[2] != worse.effects[0].p[2]);
  }
  EXPECT_NEAR(slip.start.left, slip.left_at(slip.start.hypotheses[0]), 0.02 * slip.start.left);
  ASSERT_EQ(slip.start.directions.size(), 3u);
  for (const Directions& d : slip.start.directions) {
    EXPECT_EQ(d.numbers, 3u) << "a size and two shapes";
    EXPECT_EQ(d.sizes.size(), 1u);
  }
}

TEST(BestStart, OfAPushEndsAfterItHasBegun) {
  // While the joint rises: a contact would be there on its way back, too.
  const MadeStart push("external_force", [](double t) { return slow_swing(t) + (t > 0.7 && t < 1.7 ? 1e-3 : 0.0); });
  ASSERT_EQ(push.start.hypotheses.size(), 3u);
  const double* p = push.start.hypotheses[0].effects.at(0).p;
  EXPECT_GT(p[0], 0);
  // Of ten instants in four seconds one is 0.1 s before the push, and one 0.1 s after it.
  EXPECT_NEAR(p[1], 0.7, 0.35);
  EXPECT_NEAR(p[2], 1.7, 0.35);
  for (const Hypothesis& h : push.start.hypotheses) EXPECT_LT(h.effects.at(0).p[1], h.effects.at(0).p[2]);
  ASSERT_FALSE(push.start.directions.empty());
  EXPECT_EQ(push.start.directions[0].numbers, 4u) << "the force with its instants and rise, and no contact";
  for (const Directions& d : push.start.directions)
    EXPECT_LT(d.neutral.effects.at(0).p[1], d.neutral.effects.at(0).p[2]);
}

TEST(BestStart, OfAPushIsInTheLogAndNotInItsPause) {
  // Two minutes without a row after the first 4 s. Before a log is split there, its clock goes on.
  const ArmModel model = first_joints(1);
  const PlacedEffect candidate = place_effect(*find_effect("external_force"), model.nominal, 0);
  const Log before = MadeStart::log_with([](double t) { return slow_swing(t) + (t > 0.7 && t < 1.7 ? 1e-3 : 0.0); }, 4);
  Log log = before;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double t = 124 + before.time[i];
    log.time.push_back(t);
    log.motor_position[0].push_back(before.motor_position[0][i]);
    log.joint_position[0].push_back(slow_swing(before.time[i]));
  }
  const Evidence evidence(make_records(log, model, {}), model);
  ASSERT_EQ(evidence.records().size(), 2u);
  const Screen screen(evidence, {model.nominal, {}}, {}, std::vector<double>(2, 1.0));
  const Start start = best_start(evidence, screen, {model.nominal, {candidate}}, model.nominal);
  ASSERT_FALSE(start.hypotheses.empty());
  const double* p = start.hypotheses[0].effects.at(0).p;
  EXPECT_NEAR(p[1], 0.7, 0.5);
  EXPECT_NEAR(p[2], 1.7, 0.5);
}

/// Where the joint would be drawn up, a wall below would push it up, but everywhere below.
TEST(BestStart, DoesNotPromiseWhatAContactOnTheOtherSideWouldExplain) {
  constexpr double kFrom = 1.0, kDuration = 15;  // rad; s, in which the joint is above that four times
  const auto drawn_up = [](double t) { return slow_swing(t) + 3e-3 * std::max(0.0, slow_swing(t) - kFrom); };
  const MadeStart start("external_force", drawn_up, kDuration);
  const double left = start.start.left / start.left_at(start.from);
  EXPECT_LE(start.start.promise, 1.1 - left);
}

TEST(BestStart, LeadsAContactOnlyToTheSideOnWhichItWasTried) {
  const MadeStart push("external_force", [](double t) { return slow_swing(t) + (t > 1.5 && t < 2.5 ? -1e-3 : 0.0); });
  int contacts = 0;
  for (const Directions& d : push.start.directions) {
    if (d.numbers != 2) continue;  // stiffness and position; a push has a force and three shapes
    ++contacts;
    const FitParameter& stiffness = d.sizes.at(0);
    EXPECT_TRUE((stiffness.lower == 0) != (stiffness.upper == 0)) << stiffness.lower << " to " << stiffness.upper;
  }
  EXPECT_GT(contacts, 0);
}

}  // namespace
}  // namespace halyard

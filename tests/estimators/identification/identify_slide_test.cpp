/// Numbers of a linear arm, found from short logs: what the intervals, the trace and the remarks have to be.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "estimators/identification/batch_estimate.h"
#include "estimators/identification/filter_run.h"
#include "estimators/identification/identify.h"
#include "model/statistics/distributions.h"
#include "tests/estimators/identification/linear_slide.h"
#include "tests/support/message_of.h"

namespace halyard {
namespace {

const std::string kBiasKey = "joint1.motor.torque_bias", kInertiaKey = "joint1.motor.inertia";
constexpr double kModelBias = 0.01;  // N m

/// The slide with a bias of its motor's torque, and numbers that are exact unless a test says otherwise.
ArmModel biased_slide() {
  ArmModel model = slide();
  model.nominal.joint[0].torque_bias = kModelBias;
  model.joints[0].tolerances = {
      .length = 0, .mass = 0, .com = 0, .inertia = 0, .stiffness = 0, .friction = 0, .coupling = 0, .torque_scale = 0};
  return model;
}

Log log_of_slide(const ArmModel& robot, double seconds, unsigned seed, SlideMotion motion = {}) {
  Log log(1);
  log.source = "slide.csv";
  for (const EncoderSample& s :
       record_of_slide(robot, static_cast<int>(std::lround(seconds / motion.step_s)) + 1, seed, motion)) {
    log.time.push_back(s.time_s);
    log.motor_torque[0].push_back(s.motor_torque(0));
    log.motor_position[0].push_back(s.motor_position(0));
    log.joint_position[0].push_back(s.joint_position(0));
  }
  return log;
}

double half_width(const IdentifiedNumber& n) { return (n.upper - n.lower) / 2; }

TEST(IdentifyOnALinearArm, IntervalsHoldTheTruthAndLieAboutTheValue) {
  const ArmModel model = biased_slide();
  ArmModel robot = model;
  robot.nominal.joint[0].torque_bias = 1.4 * kModelBias;
  robot.nominal.joint[0].rotor_inertia *= 1.1;
  int held = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Identification found = identify(model, {log_of_slide(robot, 4, seed)}, {kBiasKey, kInertiaKey});
    ASSERT_EQ(found.numbers.size(), 2u);
    // In the order of the model's numbers, not in that of the keys.
    const IdentifiedNumber &inertia = found.numbers[0], &bias = found.numbers[1];
    ASSERT_EQ(inertia.key, kInertiaKey);
    ASSERT_EQ(bias.key, kBiasKey);
    const double J = robot.nominal.joint[0].rotor_inertia, b = robot.nominal.joint[0].torque_bias;
    held += (inertia.lower <= J && J <= inertia.upper) + (bias.lower <= b && b <= bias.upper);
    // A number that may have either sign has an interval about it, one that may not has one in proportion.
    EXPECT_NEAR(bias.lower + bias.upper, 2 * bias.value, 1e-12 * kModelBias);
    EXPECT_NEAR(inertia.lower * inertia.upper / (inertia.value * inertia.value), 1, 1e-12);
    EXPECT_GT(inertia.lower, model.nominal.joint[0].rotor_inertia);
    EXPECT_EQ(inertia.convergence, Convergence::converged);
    EXPECT_TRUE(found.converged);
    EXPECT_TRUE(found.deviating.empty());
    EXPECT_EQ(inertia.nominal, model.nominal.joint[0].rotor_inertia);
    EXPECT_EQ(found.model.nominal.joint[0].rotor_inertia, inertia.value);
    EXPECT_EQ(found.model.nominal.joint[0].torque_bias, bias.value);
  }
  EXPECT_GE(held, 6);  // of 8; fewer by a chance of 0.6 %
}

TEST(IdentifyOnALinearArm, TheTraceGoesFromThePriorToTheEstimate) {
  const ArmModel model = biased_slide();
  ArmModel robot = model;
  robot.nominal.joint[0].rotor_inertia *= 1.1;
  const Identification found = identify(model, {log_of_slide(robot, 4, 1)}, {kInertiaKey, kBiasKey});
  // About a thousand rows.
  EXPECT_NEAR(static_cast<double>(found.time.size()), 1000, 10);
  EXPECT_EQ(found.time.front(), 0);
  EXPECT_NEAR(found.time.back(), 4, 2 * 4e-3);
  EXPECT_TRUE(std::ranges::is_sorted(found.time));
  const double prior[] = {0.5 * model.nominal.joint[0].rotor_inertia, 0.5 * kModelBias};
  for (int i = 0; i < 2; ++i) {
    const IdentifiedNumber& n = found.numbers[i];
    ASSERT_EQ(n.trace.size(), found.time.size());
    ASSERT_EQ(n.trace_std.size(), found.time.size());
    EXPECT_EQ(n.trace.front(), n.nominal) << n.key;
    EXPECT_NEAR(n.trace_std.front(), prior[i], 1e-12 * prior[i]) << n.key;
    // What was learnt is widened to the estimate's own deviation; a part of the prior's is left.
    const double deviation = half_width(n) / t_quantile(found.blocks - 1, 0.025);
    EXPECT_NEAR(n.trace_std.back(), deviation, 0.15 * deviation) << n.key;
    EXPECT_NEAR(n.trace.back(), n.value, 4 * n.trace_std.back()) << n.key;
  }
}

TEST(IdentifyOnALinearArm, BlocksAreOfASecondButSixAtLeastAndTwentyAtMost) {
  const ArmModel model = biased_slide();
  const SlideMotion slow{.step_s = 1e-2};
  EXPECT_EQ(identify(model, {log_of_slide(model, 4, 1, slow)}, {kBiasKey}).blocks, 6);
  EXPECT_EQ(identify(model, {log_of_slide(model, 9.5, 1, slow)}, {kBiasKey}).blocks, 9);
  EXPECT_EQ(identify(model, {log_of_slide(model, 5, 1, slow), log_of_slide(model, 6.5, 2, slow)}, {kBiasKey}).blocks,
            11);
  EXPECT_EQ(identify(model, {log_of_slide(model, 25, 1, slow)}, {kBiasKey}).blocks, 20);
}

TEST(IdentifyOnALinearArm, TwoLogsTellAsMuchAsOneOfTheirLength) {
  const ArmModel model = biased_slide();
  const SlideMotion slow{.step_s = 1e-2};
  const Log first = log_of_slide(model, 10, 1, slow), second = log_of_slide(model, 10, 2, slow),
            both = log_of_slide(model, 20, 1, slow);
  const Identification two = identify(model, {first, second}, {kBiasKey}), one = identify(model, {both}, {kBiasKey});
  EXPECT_EQ(two.blocks, one.blocks);
  EXPECT_NEAR(two.time.back(), 20, 0.05);
  EXPECT_TRUE(std::ranges::is_sorted(two.time));
  // A deviation from 20 blocks scatters by a sixth; four of them, and the half second in which the second log settles.
  EXPECT_NEAR(half_width(two.numbers[0]) / half_width(one.numbers[0]), 1, 0.7);
}

TEST(IdentifyOnALinearArm, AnotherNumberFarFromTheModelIsToldAndNoneThatIsRight) {
  ArmModel model = biased_slide();
  model.nominal.joint[0].joint_viscous = 400;
  model.joints[0].tolerances.friction = 0.1;
  model.joints[0].tolerances.torque_scale = 0.05;
  ArmModel robot = model;
  robot.nominal.joint[0].joint_viscous *= 1.5;
  const Identification found = identify(model, {log_of_slide(robot, 4, 1, {.amplitude = 0.5})}, {kBiasKey});
  ASSERT_EQ(found.deviating.size(), 1u);
  const DeviatingNumber& viscous = found.deviating[0];
  EXPECT_EQ(viscous.name, "joint 1 viscous friction");
  EXPECT_EQ(viscous.unit, "N s/m");
  EXPECT_EQ(viscous.nominal, 400);
  EXPECT_NEAR(viscous.tolerances, (viscous.value / viscous.nominal - 1) / 0.1, 1e-9);
  EXPECT_NEAR(viscous.tolerances, 5, 1);
  EXPECT_EQ(found.model.nominal.joint[0].joint_viscous, 400);
}

TEST(IdentifyOnALinearArm, NoOtherNumberLosesThreeQuartersOrMovesTenTolerances) {
  ArmModel model = biased_slide();
  model.nominal.joint[0].joint_viscous = 400;
  ArmModel robot = model;
  const SlideMotion fast{.amplitude = 0.5};
  const auto viscous = [&](double tolerance, double factor) {
    model.joints[0].tolerances.friction = tolerance;
    model.nominal.joint[0].motor_viscous = robot.nominal.joint[0].motor_viscous = 0;
    robot.nominal.joint[0].joint_viscous = factor * model.nominal.joint[0].joint_viscous;
    const Identification found = identify(model, {log_of_slide(robot, 4, 1, fast)}, {kInertiaKey});
    const auto told = std::ranges::find(found.deviating, "joint 1 viscous friction", &DeviatingNumber::name);
    return told == found.deviating.end() ? 1 : told->value / told->nominal;
  };
  EXPECT_NEAR(viscous(0.2, 0.01), 0.25, 1e-12);
  EXPECT_NEAR(viscous(0.02, 2), 1.2, 1e-12);
}

TEST(IdentifyOnALinearArm, WhatTheLogDoesNotTellKeepsThePriorAndIsNotExcited) {
  const ArmModel model = biased_slide();
  const Identification found =
      identify(model, {log_of_slide(model, 4, 1, {.amplitude = 0})}, {"joint1.friction.viscous", kBiasKey});
  // Half a decade of 2 N s/m: beside 100 kg, and forces of 40 N that are noise.
  EXPECT_EQ(found.numbers[1].key, "joint1.friction.viscous");
  EXPECT_EQ(found.numbers[1].convergence, Convergence::not_excited);
  EXPECT_NEAR(std::log(found.numbers[1].upper / found.numbers[1].value), t_quantile(found.blocks - 1, 0.025) * 0.5,
              0.05 * t_quantile(found.blocks - 1, 0.025));
  EXPECT_EQ(found.numbers[0].convergence, Convergence::converged);
}

TEST(IdentifyOnALinearArm, ABiasThatGrowsIsDrifting) {
  ArmModel model = biased_slide();
  model.nominal.joint[0].torque_bias = 0.1;  // N m, a prior that is wide beside the drift
  const Identification found = identify(model, {log_of_slide(model, 6, 1, {.untold_per_s = 0.01})}, {kBiasKey});
  EXPECT_EQ(found.numbers[0].convergence, Convergence::drifting);
}

TEST(IdentifyOnALinearArm, AnUnknownZeroOfTheMotorsEncoderIsFoundAlong) {
  ArmModel model = biased_slide();
  model.nominal.joint[0].motor_zero_known = false;
  Log log = log_of_slide(model, 4, 1);
  const IdentifiedNumber as_it_is = identify(model, {log}, {kInertiaKey}).numbers[0];
  for (double& angle : log.motor_position[0]) angle += 0.005 / model.nominal.joint[0].motor_travel();  // 5 mm
  const IdentifiedNumber moved = identify(model, {log}, {kInertiaKey}).numbers[0];
  // The prior of the zero, 10 mm, weighs little beside 4 s.
  EXPECT_NEAR(moved.value, as_it_is.value, 0.01 * half_width(as_it_is));
  EXPECT_NEAR(half_width(moved), half_width(as_it_is), 0.01 * half_width(as_it_is));
}

TEST(IdentifyOnALinearArm, AFilterThatTakesTheArmForQuietIsToldAndItsIntervalsHold) {
  const ArmModel robot = biased_slide();
  ArmModel model = robot;
  model.estimators.at("sr_ukf") = {{"torque_noise", "0.001"}, {"joint_force_noise", "0.25"}};  // a twentieth
  int held = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Identification found = identify(model, {log_of_slide(robot, 4, seed)}, {kBiasKey, kInertiaKey});
    EXPECT_GT(found.innovation_size, 3);
    EXPECT_LT(found.innovation_size, 30);
    for (const IdentifiedNumber& n : found.numbers) held += n.lower <= n.nominal && n.nominal <= n.upper;
  }
  EXPECT_GE(held, 6);  // of 8; fewer by a chance of 0.6 %
  EXPECT_LT(identify(robot, {log_of_slide(robot, 4, 1)}, {kBiasKey}).innovation_size, 1.1);
}

TEST(IdentifyOnALinearArm, AnArmThatCannotBeIntegratedIsToldWithLogAndModel) {
  ArmModel model = biased_slide();
  model.nominal.joint[0].motor_viscous = 1e6;  // N m s/rad, settles within 20 ps
  const std::string message = message_of([&] { identify(model, {log_of_slide(biased_slide(), 4, 1)}, {kBiasKey}); });
  EXPECT_EQ(message.find("slide.csv: cannot be followed by slide.xml: process model: a step of"), 0u) << message;
}

TEST(BatchEstimate, EndsAtTheSameNumbersFromAnyStart) {
  const ArmModel model = biased_slide();
  const Unknowns unknowns = list_unknowns(model, {kBiasKey, kInertiaKey});
  const std::vector<Log> logs = {log_of_slide(model, 4, 1)};
  const auto from = [&](double inertia, double bias) {
    return estimate_from_blocks(model, unknowns, logs, Eigen::Vector2d(inertia, bias), [](int, double) {});
  };
  const BatchEstimate near = from(0, 0);
  ASSERT_TRUE(near.converged);
  for (const auto& [inertia, bias] : {std::pair(2.0, -2.0), std::pair(-50.0, 50.0)}) {
    const BatchEstimate far = from(inertia, bias);
    EXPECT_TRUE(far.converged);
    EXPECT_LT((far.estimate.u - near.estimate.u).cwiseAbs().maxCoeff(), 0.2 * near.estimate.deviation.maxCoeff());
  }
}

TEST(BatchEstimate, TakesLessProcessNoiseForAQuietLog) {
  const ArmModel model = biased_slide();
  ArmModel quiet = model;
  quiet.estimators["sr_ukf"] = {{"torque_noise", "0.001"}, {"joint_force_noise", "0.25"}};  // a twentieth
  const Unknowns unknowns = list_unknowns(model, {kBiasKey});
  const auto disturbances_of = [&](const ArmModel& robot) {
    return estimate_from_blocks(model, unknowns, {log_of_slide(robot, 2, 1)}, Eigen::VectorXd::Zero(1),
                                [](int, double) {})
        .disturbances;
  };
  EXPECT_EQ(disturbances_of(model), 1);
  EXPECT_LE(disturbances_of(quiet), 0.1);
}

TEST(BatchEstimate, StartsAtTheModelWhereTheFilterEndsAtAnArmThatCannotBeIntegrated) {
  ArmModel model = biased_slide(), stiff = model;
  model.nominal.joint[0].motor_viscous = 5.5;
  stiff.nominal.joint[0].motor_viscous = 5.5 * std::exp(3 * 0.5);  // three deviations more
  ASSERT_NO_THROW(ProcessModel(model).substeps(kSlideStep));
  ASSERT_THROW(ProcessModel(stiff).substeps(kSlideStep), std::runtime_error);
  const Unknowns unknowns = list_unknowns(model, {"joint1.motor.viscous"});
  const std::vector<Log> logs = {log_of_slide(model, 0.6, 1)};
  int passes = 0;
  const BatchEstimate found = estimate_from_blocks(model, unknowns, logs, Eigen::VectorXd::Constant(1, 3),
                                                   [&](int pass, double) { passes = pass; });
  EXPECT_GE(passes, 2);
  EXPECT_LT(std::abs(found.estimate.u(0)), 1);
}

TEST(BatchEstimate, StartsWhereTheFilterEndedButWithinThreeDeviations) {
  const ArmModel model = biased_slide();
  const Unknowns unknowns = list_unknowns(model, {kBiasKey});
  const auto passes_again = [&](double deviations) {
    ArmModel robot = model;
    robot.nominal.joint[0].torque_bias += deviations * 0.5 * kModelBias;
    const std::vector<Log> logs = {log_of_slide(robot, 2, 1, {.step_s = 1e-2})};
    const auto from = [&](const Eigen::VectorXd& u, int& passes) {
      return estimate_from_blocks(model, unknowns, logs, u, [&](int pass, double) { passes = pass; });
    };
    int passes = 0;
    const BatchEstimate found = from(Eigen::VectorXd::Zero(1), passes);
    EXPECT_GE(passes, 2);
    EXPECT_NEAR(found.estimate.u(0), deviations, 0.4);
    from(found.estimate.u, passes);
    return passes;
  };
  EXPECT_EQ(passes_again(2), 2);  // it is there; another tells that less process noise explains the log worse
  EXPECT_EQ(passes_again(-2), 2);
  EXPECT_GE(passes_again(3.5), 3);  // it starts half a deviation before
  EXPECT_GE(passes_again(-3.5), 3);
}

TEST(BatchEstimate, EachBlockHasTheSamplesOfItsOwnTime) {
  const ArmModel model = biased_slide();
  ArmModel robot = model;
  robot.nominal.joint[0].torque_bias = 2 * kModelBias;
  Log log = log_of_slide(robot, 6, 1, {.step_s = 1e-2});
  for (std::size_t i = 0; i < log.size(); ++i)
    if (log.time[i] < 4) log.motor_position[0][i] = std::numeric_limits<double>::quiet_NaN();
  const BatchEstimate found = estimate_from_blocks(model, list_unknowns(model, {kBiasKey}), {log},
                                                   Eigen::VectorXd::Zero(1), [](int, double) {});
  EXPECT_EQ(found.estimate.blocks, 2) << "of six, those that have readings";
  EXPECT_NEAR(found.estimate.u(0), 2, 0.8);
  // Two of the six blocks tell of the bias, and agree. If one had it all, nothing would be left without it.
  EXPECT_LT(found.estimate.deviation(0), 0.8);
}

TEST(IdentifyOnALinearArm, ProgressGoesFromNothingToAllInEachStage) {
  const ArmModel model = biased_slide();
  std::vector<std::string> stages;
  double last = 0;
  identify(model, {log_of_slide(model, 4, 1)}, {kBiasKey}, [&](const std::string& stage, double fraction) {
    if (stages.empty() || stages.back() != stage) {
      EXPECT_EQ(fraction, 0) << stage;
      stages.push_back(stage);
    } else {
      EXPECT_GT(fraction, last) << stage;
    }
    EXPECT_LE(fraction, 1) << stage;
    last = fraction;
  });
  EXPECT_GT(last, 0.8);
  ASSERT_GE(stages.size(), 2u);
  EXPECT_EQ(stages[0], "dual filter");
  for (std::size_t pass = 1; pass < stages.size(); ++pass)
    EXPECT_EQ(stages[pass], "estimate, pass " + std::to_string(pass));
}

TEST(FilterRun, TimeGoesOnFromLogToLogWhenTheyBegin) {
  const ArmModel model = biased_slide();
  const SlideMotion slow{.step_s = 1e-2};
  std::vector<Log> logs = {log_of_slide(model, 0.5, 1, slow), log_of_slide(model, 0.3, 2, slow)};
  for (double& time : logs[0].time) time += 7;
  for (double& time : logs[1].time) time += 100;
  DualUkf filter(model, list_unknowns(model, {kBiasKey}).learnt_weights());
  std::vector<double> times, fractions;
  run_filter(
      filter, logs, [&](double fraction) { fractions.push_back(fraction); },
      [&](const DualStep&, double time) { times.push_back(time); });
  ASSERT_EQ(times.size(), 51u + 31u);
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(times[i], i < 51 ? 0.01 * double(i) : 0.5 + 0.01 * double(i - 51), 1e-12) << i;
  // At the first sample of each log.
  ASSERT_EQ(fractions.size(), 2u);
  EXPECT_EQ(fractions[0], 0);
  EXPECT_NEAR(fractions[1], 0.5 / 0.8, 1e-12);
}

}  // namespace
}  // namespace halyard

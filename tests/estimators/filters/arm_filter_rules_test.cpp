/// Rules of a Gaussian filter on the arm: ranges of its options, cuts of a long step, and what a reset forgets.

#include "estimators/filters/arm_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimators/built_in.h"
#include "estimators/filters/ekf.h"
#include "tests/estimators/process/held_force.h"
#include "tests/support/arm_runs.h"
#include "tests/support/limits.h"
#include "tests/support/linear_gaussian.h"
#include "tests/support/message_of.h"
#include "tests/support/pendulum.h"

namespace halyard {
namespace {

TEST(ArmFilter, OptionsAtTheEndsOfTheirRangesAreTakenAndNoneBeyond) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const auto answer = [&](const std::string& name, const std::string& text) {
    const EstimatorOptions given = {{name, text}};
    OptionReader options("the test", given);
    return message_of([&] { read_arm_filter_options(options, model, process); });
  };
  struct Ends {
    std::string name, taken, refused;
  };
  for (const Ends& e :
       {Ends{"max_step", "1e-6", "9e-7"}, Ends{"restart_gap", "1e-3", "9e-4"}, Ends{"gate", "0.5", "0.49"},
        Ends{"gate", "1", "1.01"}, Ends{"encoder_noise", "1e-9", "0"}, Ends{"effect_noise_time", "1e-6", "0"}}) {
    EXPECT_EQ(answer(e.name, e.taken), "no InputError") << e.name;
    EXPECT_NE(answer(e.name, e.refused), "no InputError") << e.name;
  }
}

TEST(ArmFilter, ASpanHasAtLeastOneStepAndNoneThatIsTooLong) {
  EXPECT_EQ(steps_over(0.001, 1e7), 1);
  EXPECT_EQ(steps_over(0.02, 0.01), 2);
  EXPECT_EQ(steps_over(0.0201, 0.01), 3);
  EXPECT_EQ(steps_over(1e6, 1e-6), 1000000000) << "no more than an int holds";
}

TEST(ArmFilter, ASampleIsOneStepHoweverLongStepsMayBe) {
  const ArmModel model = raven2();
  const ArmRun run = run_arm(model, 0.5);
  EXPECT_EQ(rms_error(*make_ekf(model, {{"max_step", "1e7"}}), run, 0), rms_error(*make_ekf(model, {}), run, 0));
}

TEST(ArmFilter, AnArmWithoutMotorsIsPredicted) {
  const auto filter = make_ekf(pendulum(), {});
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(1, std::numeric_limits<double>::quiet_NaN());
  filter->reset({0, none, none, {}});
  for (int i = 1; i <= 100; ++i) filter->update({1e-3 * i, none, none, {}});
  EXPECT_TRUE(std::isfinite(filter->estimate().joint_position(0)));
  EXPECT_TRUE(std::isfinite(filter->estimate().joint_velocity(0)));
}

/// The RAVEN-II at rest at home, under no torque.
Sample at_home(const ArmModel& model, double time_s) {
  return {time_s, Eigen::VectorXd::Zero(3), unstretched_motors(model.nominal, model.home()), {}};
}

/// Sub-steps only, so that a prediction is a known computation.
std::unique_ptr<ArmFilter> sub_step_filter(const ArmModel& model, double max_step_s) {
  const auto process = std::make_shared<const ProcessModel>(model);
  const ArmFilterOptions options{.noise = levels_of(model, *process), .max_step = max_step_s, .exponential = false};
  return std::make_unique<ArmFilter>(model, process, options, std::make_unique<ExtendedKalmanFilter>());
}

TEST(ArmFilter, CutsATimeIntoEqualPiecesOfAtMostTheLongestStep) {
  const ArmModel model = raven2();
  ArmFilter::Predictions predictions;
  const auto filter = sub_step_filter(model, 0.01);
  filter->record_into(predictions);
  // 0.07 / 0.01 is 7.000000000000001.
  for (const auto& [span, pieces] : {std::pair(0.07, 7), std::pair(0.071, 8), std::pair(0.01, 1)}) {
    filter->reset(at_home(model, 0));
    predictions.clear();
    filter->update(at_home(model, span));
    EXPECT_EQ(predictions.size(), static_cast<std::size_t>(pieces)) << span;
  }
}

TEST(ArmFilter, ALongStepGoesThroughTheSameInstantsAsSamplesWithoutReadings) {
  constexpr double kPiece = 1.0 / 128;  // s; sums of it are exact
  ArmModel model = raven2();
  add_effect(model, "cable_slip", 1, {1e-4, 1.5 * kPiece});  // depends on the time
  const auto whole = sub_step_filter(model, kPiece), walked = sub_step_filter(model, kPiece);
  for (const auto& filter : {whole.get(), walked.get()}) filter->reset(at_home(model, 0));
  for (const int i : {1, 2}) {
    Sample blind = at_home(model, i * kPiece);
    blind.motor_position.setConstant(kNan);
    walked->update(blind);
  }
  for (const auto& filter : {whole.get(), walked.get()}) filter->update(at_home(model, 3 * kPiece));
  EXPECT_EQ(whole->filter().x(), walked->filter().x());
  EXPECT_EQ(Eigen::MatrixXd(whole->filter().S()), Eigen::MatrixXd(walked->filter().S()));
}

TEST(ArmFilter, PredictsUnderTheTorqueAndTheLoadOfTheSampleBefore) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const auto filter = sub_step_filter(model, 0.01);
  const Eigen::Vector3d torque(0.02, -0.03, 0.01), load(0.4, -0.3, 1);
  Sample s = at_home(model, 0);
  s.motor_torque = torque;
  s.joint_torque = load;
  filter->reset(s);
  Eigen::VectorXd x = filter->filter().x();
  process.advance({0, 1e-3, torque.data(), load.data()}, x.data());
  Sample blind = at_home(model, 1e-3);  // whose own torque and load act later
  blind.motor_position.setConstant(kNan);
  blind.joint_torque = Eigen::Vector3d::Zero();
  filter->update(blind);
  for (int i = 0; i < 12; ++i)
    EXPECT_NEAR(filter->filter().x()(i), x(i), 1e-10 * std::max(1.0, std::abs(x(i)))) << process.state_name(i);
}

TEST(ArmFilter, AMeasurementBesideTheMotorsPassesTheSameGateAndIsCounted) {
  const ArmModel model = raven2();
  const auto process = std::make_shared<const ProcessModel>(model);
  ArmFilter filter(model, process, {.noise = levels_of(model, *process), .gate = 0.99},
                   std::make_unique<ExtendedKalmanFilter>());
  filter.reset(at_home(model, 0.5));
  const int state = process->layout().position[0];
  const LinearReadings position(Eigen::RowVectorXd::Unit(process->n_states(), state), true);
  const ReadingMatrix R_root = ReadingMatrix::Constant(1, 1, 1e-3);
  const double at = filter.filter().x()(state), deviation = std::hypot(1e-3, filter.estimate().joint_position_std(0));
  const auto measured = [&](double z) { return filter.correct_with(position, ReadingVector::Constant(1, z), R_root); };
  // 99 % of a normal number lie within 2.58 deviations.
  const Innovation refused = measured(at + 2.6 * deviation);
  EXPECT_FALSE(refused.accepted);
  EXPECT_EQ(refused.time_s, 0.5);
  EXPECT_EQ(filter.report().gated, 1);
  EXPECT_EQ(filter.filter().x()(state), at);
  EXPECT_TRUE(measured(at + 2.55 * deviation).accepted);
  EXPECT_EQ(filter.report().gated, 1);
  EXPECT_GT(filter.filter().x()(state), at);
}

TEST(SrUkfOnTheArm, AResetForgetsAllOfTheRecordBefore) {
  ArmModel model = raven2();
  add_effect(model, "delay", 0, {2e-3});
  const EstimatorOptions options = {{"adaptation_time", "0.05"}};
  const auto used = make_sr_ukf(model, options), fresh = make_sr_ukf(model, options);
  // A record elsewhere, in motion and under load.
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d q = model.home() + Eigen::Vector3d(0.2 + 1e-5 * i, -0.1 - 1e-5 * i, 0.02);
    Sample s{1e-3 * i, Eigen::Vector3d(0.05, -0.05, 0.02), unstretched_motors(model.nominal, q),
             Eigen::Vector3d(0.5, -0.3, 1)};
    if (i == 0) used->reset(s);
    else used->update(s);
  }
  for (int i = 0; i < 8; ++i) {
    Sample s = at_home(model, 1e-3 * i);
    s.motor_torque = Eigen::Vector3d(-0.01, 0.02, 0.01);
    for (Estimator* estimator : {used.get(), fresh.get()}) {
      if (i == 0) estimator->reset(s);
      else estimator->update(s);
    }
    const Estimate a = used->estimate(), b = fresh->estimate();
    EXPECT_EQ(a.joint_position, b.joint_position) << i;
    EXPECT_EQ(a.joint_velocity, b.joint_velocity) << i;
    EXPECT_EQ(a.joint_position_std, b.joint_position_std) << i;
  }
}

TEST(SrUkfOnTheArm, AfterAResetItWaitsAgainForMotorsThatHaveNotBeenRead) {
  const ArmModel model = raven2();
  const auto ukf = make_sr_ukf(model, {});
  ukf->reset(at_home(model, 0));
  ukf->update(at_home(model, 1e-3));
  Sample blind = at_home(model, 0);
  blind.motor_position(2) = kNan;
  ukf->reset(blind);
  EXPECT_EQ(ukf->estimate().joint_position, model.home());
  EXPECT_EQ(ukf->update(at_home(model, 1e-3)).nu.size(), 0);
}

TEST(SrUkfOnTheArm, ARecordMayBeginAtAnyTime) {
  const ArmModel model = raven2();
  const auto ukf = make_sr_ukf(model, {});
  ukf->reset(at_home(model, 1000));
  EXPECT_EQ(ukf->update(at_home(model, 1000.001)).nu.size(), 3) << "it is no restart";
}

TEST(ArmFilter, AStepThatIsRefusedIsHalvedUntilItIsAsShortAsSubStepsButFiveTimesAtMost) {
  for (const double span : {1e-3, 0.05}) {
    ArmModel model = raven2();
    add_effect(model, "cable_slip", 1, {1e-4, span / 2, 0});  // depends on the time
    const auto process = std::make_shared<const ProcessModel>(model);
    NoiseLevels silent = levels_of(model, *process);
    silent.torque.setZero();
    silent.joint_force.setZero();
    ArmFilter::Predictions predictions;
    ArmFilter filter(model, process, {.noise = silent, .max_step = 1}, std::make_unique<ExtendedKalmanFilter>());
    filter.record_into(predictions);
    filter.reset(at_home(model, 0));
    ArmFilter::Snapshot certain;
    filter.save(certain);
    certain.S.setZero();  // beside no deviation at all, no correction of the mean is small
    filter.restore(certain);
    filter.update(at_home(model, span));

    const double halvings = std::min(5.0, std::ceil(std::log2(process->substeps_needed(span))));
    ASSERT_GT(halvings, 0) << span;
    const int parts = static_cast<int>(std::exp2(halvings));
    EXPECT_EQ(predictions.size(), static_cast<std::size_t>(parts)) << span;
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    Eigen::VectorXd x = certain.x;
    for (int i = 0; i < parts; ++i)
      process->advance({i * span / parts, span / parts, none.data(), none.data()}, x.data());
    // Derivatives and plain numbers round differently; a slip at another time moves rates by 1e-3.
    for (int i = 0; i < 12; ++i)
      EXPECT_NEAR(filter.filter().x()(i), x(i), 1e-7 * std::max(1.0, std::abs(x(i)))) << process->state_name(i);
  }
}

TEST(SrUkfOnTheArm, AResetForgetsThatTheGateHasRefused) {
  const ArmModel model = raven2();
  const auto ukf = make_sr_ukf(model, {{"gate", "0.9999"}, {"restart_gap", "0.05"}});
  ukf->reset(at_home(model, 0));
  Sample wrong = at_home(model, 1e-3);
  wrong.motor_position(0) += 1;
  ASSERT_FALSE(ukf->update(wrong).accepted);
  Sample blind = at_home(model, 1), rest = at_home(model, 1.001);
  blind.motor_position(2) = kNan;
  rest.motor_position(0) = rest.motor_position(1) = kNan;
  ukf->reset(blind);
  EXPECT_EQ(ukf->update(rest).nu.size(), 0) << "now all motors have been read";
  EXPECT_EQ(ukf->update(at_home(model, 1.002)).nu.size(), 3);
}

TEST(ArmFilter, AtTheStartMotorAnglesAreAsUncertainAsTheirEncoders) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const auto filter = sub_step_filter(model, 0.01);
  filter->reset(at_home(model, 0));
  const Eigen::MatrixXd S = filter->filter().S();
  const NoiseLevels levels = levels_of(model, process);
  for (int k = 0; k < 3; ++k) {
    const int angle = *process.layout().motor_angle[k];
    EXPECT_DOUBLE_EQ(S(angle, angle), levels.encoder(k)) << k;
  }
}

TEST(ArmFilter, ARestoredFilterPredictsUnderTheLoadThatItHad) {
  const ArmModel model = raven2();
  const auto filter = sub_step_filter(model, 0.01);
  Sample loaded = at_home(model, 0);
  loaded.joint_torque = Eigen::Vector3d(0.4, -0.3, 1);
  filter->reset(loaded);
  ArmFilter::Snapshot start;
  filter->save(start);
  Sample blind = at_home(model, 1e-3);
  blind.motor_position.setConstant(kNan);
  blind.joint_torque = Eigen::Vector3d::Zero();
  filter->update(blind);
  const Eigen::VectorXd once = filter->filter().x();
  filter->restore(start);
  filter->update(blind);
  EXPECT_EQ(Eigen::VectorXd(filter->filter().x()), once);
}

TEST(ArmFilter, AdaptsOverTheTimeSinceEachMotorsInnovationBefore) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  NoiseLevels levels = levels_of(model, process);
  levels.adaptation_time = 0.5;
  ArmFilter filter(model, std::make_shared<const ProcessModel>(model), {.noise = levels},
                   std::make_unique<ExtendedKalmanFilter>());
  filter.reset(at_home(model, 0));
  Sample blind = at_home(model, 0);
  blind.motor_position.setConstant(kNan);
  for (int i = 1; i < 10; ++i) {
    blind.time_s = 1e-3 * i;
    filter.update(blind);
  }
  const Innovation innovation = filter.update(at_home(model, 0.01));
  ArmFilter::Snapshot now;
  filter.save(now);
  const double square = std::pow(innovation.nu(0), 2) / innovation.S_root.row(0).squaredNorm();
  EXPECT_NEAR(2 * std::log(now.adapted(0)), 0.01 / 0.5 * (std::min(square, 9.0) - 1), 1e-12);
}

}  // namespace
}  // namespace halyard

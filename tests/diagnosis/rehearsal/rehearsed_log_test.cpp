#include "diagnosis/rehearsal/rehearsed_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "diagnosis/holdout/holdout.h"
#include "model/input_error.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

constexpr double kReadingNoise = 1e-3;  // rad, of the joint's sensor
constexpr double kTorqueNoise = 1e-3;   // N m

ArmModel shoulder() { return first_joints(1); }

Hypothesis nominal() { return {shoulder().nominal, {}}; }

Hypothesis with(const std::string& effect) {
  return {shoulder().nominal, {place_effect(*find_effect(effect), shoulder().nominal, 0)}};
}

/// Of a clean arm, with noisy sensors.
const Log& noisy_log() {
  static const Log once = [] {
    Log log = simulate(motion(shoulder(), 8)).measured;
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (double& q : log.joint_position[0]) q += kReadingNoise * normal(random);
    for (double& u : log.motor_torque[0]) u += kTorqueNoise * normal(random);
    return log;
  }();
  return once;
}

LoggedMotion motion_of(const Log& log, const Hypothesis& found = nominal(), double late = 0) {
  return {log, rehearsal_records(log, shoulder()), late, shoulder(), found};
}

Log rehearsed(const Hypothesis& truth, std::uint32_t seed = 1) {
  Random random(seed, 0, 0);
  return motion_of(noisy_log()).as_of(truth, random);
}

/// Root mean squares of what a hypothesis leaves of the joint's reading and of the torque, at a moving joint.
struct Left {
  double joint, torque;
};
Left left_by(const Hypothesis& h, const Log& log) {
  HoldOut view{make_records(log, shoulder(), kFitBand), {}, {}};
  view.before = predict_all(view.records, h);
  const PredictionError e = prediction_errors(view, view, shoulder().nominal, &HoldOut::before);
  return {e.joint_rms[0], e.torque.moving_rms[0]};
}

TEST(RehearsedLog, LeavesToItsTruthWhatTheRealOneLeftToTheFoundModel) {
  const Left real = left_by(nominal(), noisy_log());
  for (const Hypothesis& truth : {nominal(), with("backlash"), with("torque_scale"), with("motor_friction")}) {
    const Log log = rehearsed(truth);
    const Left own = left_by(truth, log);
    const std::string of = truth.effects.empty() ? "nothing" : truth.effects[0].effect->name();
    // The same readings in another order, but for the half second at the start.
    EXPECT_NEAR(own.joint / real.joint, 1, 0.02) << of;
    // The torque's residual is filtered twice, which takes a part of the impacts in a gap.
    EXPECT_NEAR(own.torque / real.torque, 1, of == "backlash" ? 0.3 : 0.05) << of;
  }
}

TEST(RehearsedLog, ShowsItsEffect) {
  const Left slack = left_by(nominal(), rehearsed(with("backlash")));
  EXPECT_GT(slack.joint, 2 * kReadingNoise);
  const Left scaled = left_by(nominal(), rehearsed(with("torque_scale")));
  EXPECT_GT(scaled.torque, 3 * left_by(nominal(), noisy_log()).torque);
}

TEST(RehearsedLog, HasItsNoiseAtOtherTimes) {
  const Log log = rehearsed(nominal());
  double product = 0, square = 0;
  const FullPrediction p = predict_all(rehearsal_records(noisy_log(), shoulder()), nominal())[0];
  for (std::size_t i = 1000; i + 20 < log.size(); i += 2) {
    const double predicted = p.joint_reading[0][i / 2];  // on a grid of 2 ms
    const double before = noisy_log().joint_position[0][i] - predicted;
    product += before * (log.joint_position[0][i] - predicted);
    square += before * before;
  }
  // White noise of 3500 samples: a correlation of 1.7 % by chance.
  EXPECT_LT(std::abs(product / square), 0.05);
  EXPECT_NEAR(std::sqrt(square / 3500), kReadingNoise, 0.1 * kReadingNoise);
}

TEST(RehearsedLog, KeepsMotorsAndMissingCells) {
  Log log = noisy_log();
  for (std::size_t i = 0; i < log.size(); ++i)
    if (i % 10 != 0) log.joint_position[0][i] = std::numeric_limits<double>::quiet_NaN();
  Random random(1, 0, 0);
  const Log made = motion_of(log).as_of(with("backlash"), random);
  EXPECT_EQ(made.motor_position, log.motor_position);
  EXPECT_EQ(made.time, log.time);
  // At the ends the filter of the motion makes things up.
  for (std::size_t i = 20; i + 20 < log.size(); ++i)
    ASSERT_EQ(std::isnan(made.joint_position[0][i]), std::isnan(log.joint_position[0][i])) << i;
}

TEST(RehearsedLog, OfALateSensorIsLateAsWell) {
  constexpr int kLate = 8;             // rows of a millisecond, in which the joint moves by up to 5e-3 rad
  constexpr double kTwoCounts = 2e-4;  // rad: the errors of two readings
  Log log = simulate(motion(shoulder(), 8)).measured;
  const std::vector<double> true_position = log.joint_position[0];
  for (std::size_t i = 0; i < log.size(); ++i)
    log.joint_position[0][i] =
        i % 10 == 0 && i >= kLate ? true_position[i - kLate] : std::numeric_limits<double>::quiet_NaN();
  Random random(1, 0, 0);
  const Log made = motion_of(log, nominal(), 1e-3 * kLate).as_of(nominal(), random);
  const Log on_time = motion_of(log, nominal(), 1e-3 * kLate).on_time_as_of(nominal(), random);
  for (std::size_t i = 1000; i + 20 < log.size(); i += 10) {
    ASSERT_NEAR(made.joint_position[0][i], log.joint_position[0][i], kTwoCounts) << i;
    ASSERT_NEAR(on_time.joint_position[0][i], true_position[i], kTwoCounts) << i;
  }
}

TEST(RehearsedLog, IsRoundedAsASensorOfUnstatedResolution) {
  constexpr double kStep = 2e-3;  // rad
  ArmModel model = shoulder();
  model.nominal.joint[0].joint_encoder_resolution = 0;
  Log log = noisy_log();
  for (double& q : log.joint_position[0]) q = kStep * std::round(q / kStep);
  Random random(1, 0, 0);
  const LoggedMotion motion{log, rehearsal_records(log, model), 0, model, nominal()};
  const Log made = motion.as_of(with("backlash"), random);
  for (const double q : made.joint_position[0])
    if (std::isfinite(q)) {
      ASSERT_NEAR(q / kStep, std::round(q / kStep), 1e-6);
    }
}

TEST(RehearsedLog, DependsOnItsSeedAlone) {
  const Log one = rehearsed(nominal(), 3), again = rehearsed(nominal(), 3), other = rehearsed(nominal(), 4);
  EXPECT_EQ(log_csv(one), log_csv(again));
  EXPECT_NE(log_csv(one), log_csv(other));
}

TEST(RehearsedLog, CannotBeMadeOfAnArmThatCannotBeIntegrated) {
  Hypothesis impossible = nominal();
  impossible.nominal.joint[0].mass = std::numeric_limits<double>::quiet_NaN();
  Random random(1, 0, 0);
  EXPECT_THROW(motion_of(noisy_log()).as_of(impossible, random), InputError);
}

}  // namespace
}  // namespace halyard

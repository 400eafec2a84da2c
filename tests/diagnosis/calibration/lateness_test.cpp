/// The lateness of slow joint sensors, on logs of the plant whose joint sensors were read late.

#include "diagnosis/calibration/lateness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "diagnosis/holdout/holdout.h"
#include "model/log.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

constexpr std::size_t kEvery = 10;  // rows of 1 ms: a sensor of 100 Hz
constexpr double kRow = 1e-3;       // s

/// What a sensor wrote that reads so many rows late, in every n-th row.
void read_late(std::vector<double>& column, std::size_t rows_late, std::size_t every) {
  const std::vector<double> truth = column;
  for (std::size_t i = 0; i < column.size(); ++i)
    column[i] = i % every == 0 ? truth[i - std::min(i, rows_late)] : std::numeric_limits<double>::quiet_NaN();
}

const Log& two_joint_log() {
  static const Log log = simulate(motion(first_joints(2), 8)).measured;
  return log;
}

/// The log with its joint sensors late by so many rows each.
Log late_by(std::size_t first, std::size_t second, std::size_t every = kEvery) {
  Log log = two_joint_log();
  read_late(log.joint_position[0], first, every);
  read_late(log.joint_position[1], second, every);
  return log;
}

TEST(SlowSensors, ThatAreLateAreFoundLateByTheirDelay) {
  for (const std::size_t rows : {4u, 17u})
    EXPECT_NEAR(*slow_sensor_lateness(late_by(rows, rows), first_joints(2)), kRow * static_cast<double>(rows), 1e-4);
}

TEST(SlowSensors, OfAnArmWithOtherFrictionAndStiffnessAreFoundAsLate) {
  ArmModel model = first_joints(2);
  for (int k = 0; k < 2; ++k) {
    model.nominal.joint[k].stiffness *= 1.08;
    model.nominal.joint[k].joint_coulomb *= 0.85;
  }
  EXPECT_NEAR(*slow_sensor_lateness(late_by(12, 12), model), 0.012, 3e-4);
}

TEST(SlowSensors, OfALogThatIsTooShortToTellAreAsLateAsThoseOfTheOthers) {
  const ArmModel model = first_joints(2);
  const Log whole = late_by(12, 12);
  const auto cut = static_cast<std::ptrdiff_t>(3 / kRow);
  Log shorter(2);
  shorter.source = "short";
  shorter.time.assign(whole.time.begin(), whole.time.begin() + cut);
  for (int k = 0; k < 2; ++k)
    for (Signals Log::*signal : {&Log::motor_torque, &Log::motor_position, &Log::joint_position})
      (shorter.*signal)[k].assign((whole.*signal)[k].begin(), (whole.*signal)[k].begin() + cut);
  ASSERT_FALSE(slow_sensor_lateness(shorter, model));
  for (const std::vector<Log>& logs : {std::vector{shorter, whole}, std::vector{whole, shorter}}) {
    const DiagnosisData data = diagnosis_data(model, logs, whole, model);
    ASSERT_EQ(data.late.size(), 3u);
    EXPECT_EQ(data.late[0].seconds, data.late[1].seconds);
  }
}

TEST(SlowSensors, OfTheTrainingAreNotMeasuredOnTheHoldOut) {
  const ArmModel model = first_joints(2);
  const Log whole = late_by(12, 12), shorter = split_log(whole, 0.4).first;
  ASSERT_FALSE(slow_sensor_lateness(shorter, model));
  EXPECT_TRUE(diagnosis_data(model, {shorter}, whole, model).late.empty());
  const DiagnosisData data = diagnosis_data(model, {whole}, shorter, model);
  ASSERT_EQ(data.late.size(), 2u);
  EXPECT_EQ(data.late[1].seconds, data.late[0].seconds) << "the hold-out may take what the training tells";
}

TEST(SlowSensors, ThatADelayShiftsFurtherAreMeasuredAgainWithTheOtherEffects) {
  const ArmModel model = first_joints(2);
  const auto effect = [&](const char* name, EffectPlace joint) {
    return place_neutral_effect(*find_effect(name), model.nominal, joint);
  };
  PlacedEffect delay = effect("delay", kWholeArm);
  delay.p[1] = -7e-4;
  const auto names = [&](const Log& log, const std::vector<PlacedEffect>& found) {
    std::string all;
    const auto tells = model_for_lateness({log}, model, {model.nominal, found});
    if (!tells) return std::string("no other model");
    for (const PlacedEffect& e : tells->effects) all += e.effect->name() + " ";
    return all;
  };
  const PlacedEffect other = effect("hysteresis", 0);
  PlacedEffect push = effect("external_force", 1);
  push.p[0] = 1;
  EXPECT_EQ(names(late_by(4, 4), {other, delay, push}), "hysteresis ");
  EXPECT_EQ(names(late_by(4, 4), {other}), "no other model");
  EXPECT_EQ(names(late_by(4, 4), {effect("delay", 0)}), "no other model") << "one sensor is late against the others";
  EXPECT_EQ(names(late_by(4, 4, 1), {other, delay}), "no other model") << "sensors with the motors' clock";
  delay.p[0] = 2e-3;
  EXPECT_EQ(names(late_by(4, 4), {other, delay}), "no other model") << "the torques act late, too";
}

TEST(SlowSensors, AreMeasuredAgainBesideSensorsThatTellNoLateness) {
  ArmModel model = first_joints(3);
  model.nominal.joint[2].drive = Drive::none;
  const Log log = late_by(4, 4);
  Log of_three(3);
  of_three.time = log.time;
  for (int k = 0; k < 2; ++k) {
    of_three.motor_position[k] = log.motor_position[k];
    of_three.joint_position[k] = log.joint_position[k];
  }
  of_three.joint_position[2].assign(log.size(), 0.4);
  const PlacedEffect delay = place_neutral_effect(*find_effect("delay"), model.nominal, kWholeArm);
  EXPECT_TRUE(model_for_lateness({of_three}, model, {model.nominal, {delay}})) << "of a joint without a motor";
  for (const int k : {0, 1}) of_three.joint_position[k] = two_joint_log().joint_position[k];
  EXPECT_FALSE(model_for_lateness({of_three}, model, {model.nominal, {delay}})) << "no sensor is slow";

  Log stuck = log;
  stuck.joint_position[0].assign(log.size(), 0.5);
  const ArmModel two = first_joints(2);
  EXPECT_TRUE(model_for_lateness({stuck}, two, {two.nominal, {delay}}));
}

TEST(SlowSensors, InTimeAreNotLate) { EXPECT_EQ(*slow_sensor_lateness(late_by(0, 0), first_joints(2)), 0); }

TEST(SlowSensors, OfWhichOneIsLateHaveNoCommonDelay) {
  EXPECT_EQ(*slow_sensor_lateness(late_by(0, 15), first_joints(2)), 0);
}

TEST(SlowSensors, OfAJointThatDisagreesAreOutvoted) {
  const ArmModel model = first_joints(3);
  Scenario scenario = motion(model, 8);
  for (auto& part : scenario.trajectory[2].sines) part.amplitude *= 0.2;  // m, within the slide's range
  Log log = simulate(scenario).measured;
  read_late(log.joint_position[0], 0, kEvery);
  for (const int k : {1, 2}) read_late(log.joint_position[k], 12, kEvery);
  EXPECT_NEAR(*slow_sensor_lateness(log, model), 0.012, 1e-4);
}

TEST(SlowSensors, BesideAnEffectAtOneJointAndFrictionThatIsOffAreFoundAsLate) {
  const ArmModel model = first_joints(3);
  ArmModel robot = model;
  for (int k = 0; k < 3; ++k) robot.nominal.joint[k].joint_coulomb *= 1.15;
  PlacedEffect coupling = place_neutral_effect(*find_effect("coupling"), model.nominal, 1);
  coupling.p[0] = 0.035;
  robot.effects = {coupling};
  Scenario scenario = motion(robot, 8);
  for (auto& part : scenario.trajectory[2].sines) part.amplitude *= 0.2;  // m, within the slide's range
  Log log = simulate(scenario).measured;
  for (int k = 0; k < 3; ++k) read_late(log.joint_position[k], 15, kEvery);
  EXPECT_NEAR(*slow_sensor_lateness(log, model), 0.015, 3e-4);
}

TEST(SlowSensors, AreThoseThatOftenLackTheReadingOfTheirMotorsEncoder) {
  const ArmModel model = first_joints(2);
  Log log = two_joint_log();
  std::vector<double>& column = log.joint_position[0];
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 1000; i < 2000; ++i) column[i] = none;  // a hole of a second is no clock
  EXPECT_FALSE(has_slow_joint_sensor(log, model, 0));
  for (std::size_t i = 0; i < column.size(); i += 9) column[i] = none;  // about 890 Hz
  EXPECT_TRUE(has_slow_joint_sensor(log, model, 0));
}

TEST(SlowSensors, AreNotThoseThatLackReadingsTogetherWithTheirMotors) {
  const ArmModel model = first_joints(2);
  Log log = two_joint_log();
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < log.size(); i += 9) log.joint_position[0][i] = log.motor_position[0][i] = none;
  EXPECT_FALSE(has_slow_joint_sensor(log, model, 0)) << "rows are lost";
  // Every other row is late by 0.6 ms.
  log = two_joint_log();
  for (std::size_t i = 0; i < log.size(); i += 2) log.time[i] += 0.6 * kRow;
  EXPECT_FALSE(has_slow_joint_sensor(log, model, 0)) << "a clock that jitters";
}

TEST(SlowSensors, OfAShortLogTellNothing) {
  EXPECT_FALSE(slow_sensor_lateness(split_log(late_by(12, 12), 0.5).first, first_joints(2)));
}

TEST(FastSensors, AreNeverLate) { EXPECT_EQ(*slow_sensor_lateness(late_by(15, 15, 1), first_joints(2)), 0); }

TEST(SlowSensors, OfALargerCapstanAreNotLate) {
  ArmModel model = first_joints(2);
  model.nominal.joint[0].capstan_radius *= 1.05;
  EXPECT_EQ(*slow_sensor_lateness(late_by(0, 0), model), 0);
}

TEST(LateReadings, AreMovedToTheTimeAtWhichTheyWereTrue) {
  constexpr std::size_t kRowsLate = 2 * kEvery;  // so that the samples are the same
  RecordOptions options;
  const Record in_time = make_records(late_by(0, 0), first_joints(2), options)[0];
  options.slow_sensors_late_s = kRow * kRowsLate;
  const Record moved = make_records(late_by(kRowsLate, kRowsLate), first_joints(2), options)[0];

  for (std::size_t i = 50; i + 50 < in_time.size; ++i)
    EXPECT_NEAR(moved.joint_raw[1][i], in_time.joint_raw[1][i], 1e-9) << i;
}

}  // namespace
}  // namespace halyard

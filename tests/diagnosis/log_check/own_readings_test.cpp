#include "diagnosis/log_check/own_readings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/diagnosis/log_check/checked_logs.h"
#include "tests/diagnosis/odd_logs.h"

namespace halyard {
namespace {

/// As a logger writes it that reads a sensor whenever `rows(i)` rows have passed, and repeats the reading until then.
template <class Rows>
Log with_repeats(Log log, int k, const Rows& rows, Signals Log::*signal = &Log::joint_position) {
  std::vector<double>& x = (log.*signal)[k];
  for (std::size_t begin = 0, reading = 0; begin < x.size(); ++reading) {
    const std::size_t end = std::min(x.size(), begin + rows(reading));
    for (std::size_t i = begin; i < end; ++i) x[i] = x[begin];
    begin = end;
  }
  return log;
}

TEST(OwnReadings, AreThoseBeforeTheRepeats) {
  const auto thirty_hertz = [](std::size_t reading) { return 33 + (reading % 3 == 0); };
  Log log = with_repeats(right_log(), 1, thirty_hertz);
  const std::vector<RepeatedReadings> found = keep_own_readings(log, raven());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].joint, 1);
  EXPECT_NEAR(found[0].interval, 0.033, 1e-3);
  std::size_t kept = 0, wrong = 0;
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (!std::isfinite(log.joint_position[1][i])) continue;
    ++kept;
    wrong += log.joint_position[1][i] != right_log().joint_position[1][i];
  }
  EXPECT_NEAR(static_cast<double>(kept), kCheckedDuration * 30, 3);
  EXPECT_EQ(wrong, 0u) << "a reading of another instant was kept";
}

TEST(OwnReadings, OfAMotorAreThoseWithItsTorques) {
  const auto every_fourth = [](std::size_t) { return 4; };
  Log log = with_repeats(right_log(), 0, every_fourth, &Log::motor_position);
  Log slow_torque = with_repeats(log, 0, every_fourth, &Log::motor_torque);
  for (Log* of : {&log, &slow_torque}) {
    const std::vector<RepeatedReadings> found = keep_own_readings(*of, raven());
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].signal, &Log::motor_position);
    EXPECT_NEAR(found[0].interval, 4e-3, 1e-6);
  }
  const auto kept = [](const std::vector<double>& x) {
    return std::ranges::count_if(x, [](double v) { return std::isfinite(v); });
  };
  EXPECT_NEAR(static_cast<double>(kept(log.motor_position[0])), static_cast<double>(log.size()) / 4, 0.05 * log.size());
  EXPECT_GT(kept(log.motor_torque[0]), 0.99 * static_cast<double>(log.size())) << "a command has its own rate";
  EXPECT_NEAR(static_cast<double>(kept(slow_torque.motor_torque[0])), static_cast<double>(log.size()) / 4,
              0.05 * log.size());
}

TEST(OwnReadings, OfASensorAsFastAsTheLogAreAllItsRows) {
  for (const auto& log : {right_log(), without_joint_sensors(right_log())}) {
    Log own = log;
    EXPECT_TRUE(keep_own_readings(own, raven()).empty());
  }
}

TEST(OwnReadings, OfACoarseEncoderAreAllItsRows) {
  constexpr double kCoarse = 0.01;  // rad
  ArmModel model = raven();
  model.nominal.joint[0].joint_encoder_resolution = 0;  // not told
  Log log = right_log();
  for (double& q : log.joint_position[0]) q = kCoarse * std::round(q / kCoarse);
  EXPECT_TRUE(keep_own_readings(log, model).empty());
}

TEST(OwnReadings, OfAJointBehindBacklashAreAllItsRows) {
  ArmModel robot = raven();
  robot.effects = {placed("backlash", robot, 1, {3e-3})};
  Log log = simulate(small_motion(robot)).measured;
  EXPECT_TRUE(keep_own_readings(log, raven()).empty());
}

TEST(LogWithRepeatedReadings, IsCleanAndToldOf) {
  const auto every_tenth = [](std::size_t) { return 10; };
  Logs logs = clean_logs();
  logs.train = with_repeats(logs.train, 0, every_tenth);
  const Diagnosis d = diagnosis_of(first_joints(1), logs);
  expect_clean(d);
  ASSERT_EQ(d.log_findings.size(), 1u);
  EXPECT_EQ(d.log_findings[0].severity, Severity::corrected);
  EXPECT_NE(d.log_findings[0].what.find("repeats each reading until the next one, 10 ms later"), std::string::npos)
      << d.log_findings[0].what;
}

TEST(OwnReadings, OfASensorThatRestsAndJumpsOnceAreAllItsRows) {
  Log log(1);
  for (int i = 0; i < 500; ++i) {
    log.time.push_back(1e-3 * i);
    log.joint_position[0].push_back(1e-3 * (i < 200 ? i : i < 250 ? 200 : i - 40));
  }
  const std::vector<double> all = log.joint_position[0];
  EXPECT_TRUE(keep_own_readings(log, first_joints(1)).empty());
  EXPECT_EQ(log.joint_position[0], all);
}

}  // namespace
}  // namespace halyard

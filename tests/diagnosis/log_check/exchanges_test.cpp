/// Columns that stand in each other's place: circles of three, the columns of one joint, and what looks like them.

#include "diagnosis/log_check/exchanges/exchanges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/log_check/robust.h"
#include "tests/diagnosis/log_check/checked_logs.h"

namespace halyard {
namespace {

constexpr auto kMotor = &Log::motor_position, kJoint = &Log::joint_position, kTorque = &Log::motor_torque;

/// Joint k's column has the values of joint p[k].
Log permuted(Signals Log::*signal, const std::vector<int>& p, const Log& right = right_log()) {
  Log log = right;
  for (std::size_t k = 0; k < p.size(); ++k) (log.*signal)[k] = (right.*signal)[p[k]];
  return log;
}

/// The options that undo permuted() of a circle of three, beginning with the first joint.
std::string undoing(Signals Log::*signal, const std::vector<int>& p) {
  std::string options;
  for (int i = 0, k = 0; i < 3; ++i) {
    const int from = static_cast<int>(std::ranges::find(p, k) - p.begin());
    options += (i > 0 ? " --column " : "--column ") + column_name(signal, k) + "=" + column_name(signal, from);
    k = from;
  }
  return options;
}

TEST(Exchanges, NamesACircleOfThreeColumns) {
  for (const auto signal : {kMotor, kJoint, kTorque})
    for (const std::vector<int>& p : {std::vector<int>{1, 2, 0}, std::vector<int>{2, 0, 1}})
      expect_one(permuted(signal, p), column_name(signal, 0), Severity::gross,
                 {"exchanged in a circle with " + column_name(signal, p[1] == 2 ? 2 : 1), undoing(signal, p)});
}

TEST(Exchanges, TellsWhichMotorEachJointFollows) {
  const std::vector<LogFinding> motors = check_log(permuted(kMotor, {1, 2, 0}), raven());
  ASSERT_EQ(motors.size(), 1u) << lines_of(motors);
  EXPECT_PRED_FORMAT2(testing::IsSubstring,
                      "joint 1's reading follows motor 3, joint 3's motor 2, joint 2's motor 1; expected its own motor",
                      motors[0].what);
  const std::vector<LogFinding> joints = check_log(permuted(kJoint, {1, 2, 0}), raven());
  ASSERT_EQ(joints.size(), 1u) << lines_of(joints);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "joint 3's reading follows motor 1, joint 2's motor 3, joint 1's motor 2",
                      joints[0].what);
}

TEST(Exchanges, WithoutJointSensorsATorqueTellsWhetherItOrTheMotorIsInAnothersPlace) {
  for (const auto signal : {kMotor, kTorque}) {
    for (const std::vector<int>& p : {std::vector<int>{1, 2, 0}, std::vector<int>{2, 0, 1}})
      expect_one(without_joint_sensors(permuted(signal, p)), column_name(signal, 0), Severity::gross,
                 {"exchanged in a circle", undoing(signal, p)});
    for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2)}) {
      std::vector<int> p = {0, 1, 2};
      std::swap(p[i], p[j]);
      expect_one(without_joint_sensors(permuted(signal, p)), column_name(signal, i), Severity::gross,
                 {"exchanged with " + column_name(signal, j)});
    }
  }
}

TEST(Exchanges, WithoutJointSensorsAWrongZeroIsNoExchange) {
  // Both motors move alike. Either torque goes with either motion, and exchanged they would be within their ranges.
  Scenario s = small_motion(raven());
  s.trajectory[1].sines = s.trajectory[0].sines;
  Log log = without_joint_sensors(simulate(s).measured);
  for (double& q : log.motor_position[1]) q -= 150;
  expect_one(log, "motor_position_2", Severity::suspicious, {"outside its range"});
}

TEST(Exchanges, NamesAMotorInThePlaceOfItsJoint) {
  for (int k = 0; k < 3; ++k) {
    Log log = right_log();
    std::swap(log.motor_position[k], log.joint_position[k]);
    const std::string motor = column_name(kMotor, k), joint = column_name(kJoint, k);
    expect_one(log, motor, Severity::gross,
               {"exchanged with " + joint, "--column " + motor + "=" + joint + " --column " + joint + "=" + motor});
  }
}

TEST(Exchanges, NamesATorqueInThePlaceOfAPosition) {
  for (int k = 0; k < 3; ++k)
    for (const auto signal : {kMotor, kJoint}) {
      Log log = right_log();
      std::swap(log.motor_torque[k], (log.*signal)[k]);
      const std::string torque = column_name(kTorque, k), position = column_name(signal, k);
      expect_one(
          log, position, Severity::gross,
          {"exchanged with " + torque, "--column " + position + "=" + torque + " --column " + torque + "=" + position});
      if (signal == kMotor)
        expect_one(without_joint_sensors(log), position, Severity::gross, {"exchanged with " + torque, "hardly moves"});
    }
}

TEST(Exchanges, AnExchangeAtAJointWhoseZeroIsUnknownLeavesNoOtherFinding) {
  ArmModel model = raven();
  model.nominal.joint[1].motor_zero_known = false;
  Log log = right_log();
  std::swap(log.motor_torque[1], log.motor_position[1]);
  expect_one(log, "motor_position_2", Severity::gross, {"exchanged with motor_torque_2"}, model);
}

TEST(Exchanges, KeepsAPairBesideAJointInAnotherUnit) {
  Log log = permuted(kMotor, {1, 0, 2});
  for (double& q : log.joint_position[2]) q *= 1e3;
  const std::vector<LogFinding> findings = check_log(log, raven());
  ASSERT_EQ(findings.size(), 2u) << lines_of(findings);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "--column motor_position_1=motor_position_2", findings[0].remedy);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, option("joint_position_3", "unit=mm"), findings[1].remedy);
}

TEST(Exchanges, DoesNotTakeWhatAnInboardMotorGivesForAnExchangeWithTheTorque) {
  ArmModel model = raven();
  model.nominal.joint[1].coupling[0] = -1;  // motor 1 alone moves joint 2 as far as joint 1
  Log log = simulate(small_motion(model)).measured;
  log.joint_position[1] = log.joint_position[0];
  for (const LogFinding& f : check_log(log, model)) EXPECT_EQ(f.what.find("exchanged"), f.what.npos) << finding_line(f);
}

/// Torque k with a slow wave that an effect may add, so that it goes with its motion by about r.
Log with_wave(int k, double r) {
  Log log = right_log();
  const double size = 0.5 * spread(log.motor_torque[k]) * std::sqrt(1 / (r * r) - 1);
  for (std::size_t i = 0; i < log.size(); ++i)
    log.motor_torque[k][i] += size * std::sin(2 * std::numbers::pi * 1.9 * log.time[i]);
  return log;
}

TEST(Exchanges, ACircleMayHaveOneTorqueThatAnEffectHides) {
  const Log log = with_wave(1, 0.7);
  LogCheckRule rule;
  rule.torque_goes_with = 0.9;  // hides it for certain
  rule.significance = 2.5;      // a log of 6 s has few independent samples
  const Log circle = permuted(kTorque, {1, 2, 0}, log), pair = permuted(kTorque, {1, 0, 2}, log);
  const auto says_exchanged = [&](const Log& spoilt) {
    return lines_of(check_log(spoilt, raven(), {}, rule)).find("exchanged") != std::string::npos;
  };
  EXPECT_TRUE(says_exchanged(circle));
  EXPECT_FALSE(says_exchanged(pair)) << "nothing but this torque would tell it";
  EXPECT_FALSE(says_exchanged(log));
}

TEST(Exchanges, OffersNoScaleThatNoDriveHas) {
  const std::vector<LogFinding> findings = check_log(scaled(kJoint, 0, 5000), raven());
  ASSERT_EQ(findings.size(), 1u) << lines_of(findings);
  EXPECT_EQ(findings[0].severity, Severity::gross);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "which no unit explains", findings[0].what);
  EXPECT_EQ(findings[0].remedy,
            "say which columns of the file these are, with --column joint_position_1=NAME or --column "
            "motor_position_1=NAME; if one counts the steps of its encoder, state the encoder's resolution in "
            "<encoders> of joint 1");
}

TEST(Exchanges, AFactorThatNoUnitExplainsIsGrossBeyondThree) {
  expect_one(scaled(kJoint, 0, 5), "joint_position_1", Severity::gross,
             {"times as far", "which no unit explains", "gear_ratio", option("joint_position_1", "scale=0.199")});
  expect_one(scaled(kJoint, 0, 2.9), "joint_position_1", Severity::suspicious, {"times as far", "gear_ratio"});
}

}  // namespace
}  // namespace halyard

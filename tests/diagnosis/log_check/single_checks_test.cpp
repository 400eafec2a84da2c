/// Single checks of a log, on logs that are made by hand or changed in one column.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/diagnosis/fit/made_log.h"
#include "tests/diagnosis/log_check/checked_logs.h"
#include "tests/support/message_of.h"

namespace halyard {
namespace {

TEST(TorqueCheck, SaysThatItCannotCompareTorquesOfAnArmThatCannotBeIntegrated) {
  ArmModel sharp = first_joints(1);
  const Log log = simulate(motion(sharp, 5)).measured;
  EXPECT_TRUE(found_by(check_torques, log, sharp).empty());
  sharp.nominal.joint[0].joint_smoothing = 1e-12;
  const std::vector<LogFinding> findings = found_by(check_torques, log, sharp);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].what.find("was not compared with what the motion requires"), 0u) << findings[0].what;
}

TEST(CounterCheck, TakesAStepOfALapBetweenReadingsOfMoreThanALapForNone) {
  const ArmModel model = first_joints(1);
  const double lap = std::exp2(13) * model.nominal.joint[0].joint_encoder_resolution;
  Log log(1);
  for (int i = 0; i < 3000; ++i) {
    log.time.push_back(1e-3 * i);
    log.motor_position[0].push_back(0.05 * i);
    log.joint_position[0].push_back(6e-4 * lap * i - (i < 2000 ? 0 : lap));  // 1.2 laps, a step back, 0.6 laps
  }
  EXPECT_EQ(lines_of(found_by(check_counters, log, model)), "");
}

TEST(TorqueCheck, TakesOnlyAnExtremeValueThatLastsForClipped) {
  const ArmModel model = first_joints(1);
  Log log(1);
  for (int i = 0; i < 300; ++i) log.time.push_back(0.01 * i), log.motor_torque[0].push_back(std::sin(0.1 * i));
  for (int i = 100; i < 190; ++i) log.motor_torque[0][i] = 0;  // a controller that pauses
  EXPECT_EQ(lines_of(found_by(check_clipped_torques, log, model)), "");
  for (double& t : log.motor_torque[0]) t = std::min(t, 0.75);
  const std::vector<LogFinding> clipped = found_by(check_clipped_torques, log, model);
  ASSERT_EQ(clipped.size(), 1u) << lines_of(clipped);
  EXPECT_NE(clipped[0].what.find("is exactly 0.75 in "), std::string::npos) << clipped[0].what;
}

Log without_torques(Log log) {
  for (auto& column : log.motor_torque) column.clear();
  return log;
}

TEST(PositionCheck, WithoutTorqueAndRangeAReversedSignMayBeEither) {
  ArmModel wide = raven();
  for (int k = 0; k < 3; ++k) wide.joints[k].lower = -3, wide.joints[k].upper = 3;
  const Log log = without_torques(scaled(&Log::joint_position, 0, -1));
  const std::vector<LogFinding> findings = found_by(check_positions, log, wide);
  ASSERT_EQ(findings.size(), 1u) << lines_of(findings);
  EXPECT_EQ(findings[0].column, "joint_position_1");
  EXPECT_NE(findings[0].remedy.find(", or reverse motor_position_1 with " + option("motor_position_1", "sign=-1")),
            std::string::npos)
      << findings[0].remedy;
}

TEST(PositionCheck, WithoutTorqueTheRangeTellsWhichSignIsReversed) {
  const Log log = without_torques(scaled(&Log::motor_position, 1, -1));
  const std::vector<LogFinding> findings = found_by(check_positions, log, raven());
  ASSERT_EQ(findings.size(), 1u) << lines_of(findings);
  EXPECT_EQ(findings[0].column, "motor_position_2");
  EXPECT_NE(findings[0].what.find(", and joint_position_2 is within the joint's range"), std::string::npos)
      << findings[0].what;
  EXPECT_EQ(findings[0].remedy.find(", or reverse"), std::string::npos) << findings[0].remedy;
}

TEST(PositionCheck, TellsBothColumnsOfAJointInAWrongUnitAlthoughTheyAgree) {
  const double degrees = 180 / M_PI;
  Log log = scaled(&Log::motor_position, 1, degrees);
  for (double& x : log.joint_position[1]) x *= degrees;
  const std::vector<LogFinding> findings = check_log(log, raven());
  ASSERT_EQ(findings.size(), 2u) << lines_of(findings);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string column = i == 0 ? "motor_position_2" : "joint_position_2";
    EXPECT_EQ(findings[i].column, column);
    EXPECT_EQ(findings[i].severity, Severity::gross);
    EXPECT_NE(findings[i].remedy.find(option(column, "unit=deg")), std::string::npos) << lines_of(findings);
  }
}

TEST(PositionCheck, DoesNotRefuseARightLogForARangeThatIsTooNarrow) {
  ArmModel model = raven();
  const double middle = 0.5 * (model.joints[1].lower + model.joints[1].upper);
  model.joints[1].lower = middle - 0.08, model.joints[1].upper = middle + 0.08;
  for (const LogFinding& f : check_log(right_log(), model)) {
    EXPECT_EQ(f.severity, Severity::suspicious) << finding_line(f);
    EXPECT_NE(f.remedy.find("correct the range of joint 2"), std::string::npos) << f.remedy;
  }
}

TEST(TorqueCheck, AsksForTheTorqueConstantOfACurrent) {
  const Log log = scaled(&Log::motor_torque, 0, 1 / 0.03);  // A; the map divides no further
  ColumnMap columns;
  columns.add_entry("motor_torque_1=motor_torque_1,unit=A");
  const std::vector<LogFinding> findings = check_log(log, raven(), columns);
  ASSERT_EQ(findings.size(), 1u) << lines_of(findings);
  EXPECT_EQ(findings[0].severity, Severity::gross);
  EXPECT_NE(findings[0].what.find("the column is in A or V"), std::string::npos) << findings[0].what;
  EXPECT_NE(findings[0].remedy.find("torque constant"), std::string::npos) << findings[0].remedy;
  ArmModel knows = raven();
  knows.nominal.joint[0].torque_scale = 0.03;
  EXPECT_EQ(lines_of(check_log(log, knows, columns)), "");
}

TEST(PositionCheck, CountsJointsFromOne) {
  const Log log = without_joint_sensors(scaled(&Log::motor_position, 1, 180 / 3.14159265358979));
  const std::vector<LogFinding> findings = found_by(check_positions, log, raven());
  ASSERT_EQ(findings.size(), 1u) << lines_of(findings);
  EXPECT_TRUE(findings[0].what.starts_with("moves joint 2 by ")) << findings[0].what;
}

TEST(PositionCheck, ComparesNothingWithAMotorWhoseAngleIsNotThere) {
  Log log(1);
  for (int i = 0; i < 2000; ++i) log.time.push_back(1e-3 * i), log.joint_position[0].push_back(std::sin(2e-3 * i));
  EXPECT_EQ(lines_of(found_by(check_positions, log, first_joints(1))), "");
}

LogFinding finding_of(const std::string& column, Severity severity) {
  return {"some.csv", column, "is wrong", "mend it", severity};
}

TEST(LogFindings, AGrossOneStopsADiagnosisAndCountsTheOthers) {
  const LogFinding odd = finding_of("time", Severity::suspicious),
                   wrong = finding_of("motor_torque_1", Severity::gross),
                   more = finding_of("motor_torque_2", Severity::gross);
  EXPECT_NO_THROW(stop_at_gross_finding({}));
  EXPECT_NO_THROW(stop_at_gross_finding({odd, finding_of("time", Severity::corrected)}));
  EXPECT_EQ(message_of([&] {
              stop_at_gross_finding({odd, wrong, odd});
            }),
            "some.csv: motor_torque_1: is wrong; mend it");
  EXPECT_EQ(message_of([&] {
              stop_at_gross_finding({odd, wrong, more, odd, more});
            }),
            "some.csv: motor_torque_1: is wrong; mend it (and 2 more: run halyard check on the log)");
  EXPECT_EQ(message_of([&] {
              stop_at_gross_finding({wrong, more}, ", listed above");
            }),
            "some.csv: motor_torque_1: is wrong; mend it (and 1 more, listed above)");
}

TEST(LogFindings, TellTheLineIfTheErrorIsInOne) {
  LogFinding wrong = finding_of("motor_torque_1", Severity::gross);
  wrong.line = 17;
  EXPECT_EQ(finding_line(wrong), "some.csv:17: motor_torque_1: is wrong; mend it");
}

TEST(CounterCheck, NamesEachCounterOfAnEncoderByItsBits) {
  constexpr double kPeriod = 0.7;  // rad
  ArmModel model = first_joints(1);
  Log log(1);
  for (int i = 0; i < 400; ++i) {
    log.time.push_back(1e-3 * i);
    log.joint_position[0].push_back(kPeriod * std::fmod(0.0143 * i, 1.0));
  }
  for (const int bits : {10, 12, 13, 14, 15, 16, 17, 18, 20, 24, 32}) {
    model.nominal.joint[0].joint_encoder_resolution = std::ldexp(kPeriod, -bits);
    const std::vector<LogFinding> findings = found_by(check_counters, log, model);
    ASSERT_EQ(findings.size(), 1u) << bits;
    EXPECT_EQ(findings[0].what, "starts again after 2^" + std::to_string(bits) +
                                    " counts of its encoder; expected a continuous position");
  }
}

TEST(CounterCheck, TakesJumpsForThoseOfACounterIfThereAreTwoOfItsSize) {
  const ArmModel model = first_joints(1);
  const double period = std::exp2(13) * model.nominal.joint[0].joint_encoder_resolution;
  const auto found = [&](double up, double down) {
    Log log(1);
    for (int i = 0; i < 3000; ++i) {
      log.time.push_back(1e-3 * i);
      log.motor_position[0].push_back(0.05 * i);
      log.joint_position[0].push_back(1e-4 * i + (i < 1000 ? 0 : up) - (i < 2000 ? 0 : down));
    }
    return lines_of(found_by(check_counters, log, model));
  };
  const std::string two = found(period, period);
  EXPECT_NE(two.find("joint_position_1: jumps by 0.6435 between two samples at 1 s, the first of 2 jumps, which is "
                     "2^13 counts of its encoder; expected a continuous position"),
            std::string::npos)
      << two;
  EXPECT_EQ(found(period, 0), "") << "a single one";
  EXPECT_EQ(found(period, 1.5 * period), "") << "of two sizes";
  EXPECT_EQ(found(1.03 * period, 1.03 * period), "") << "no counter has this size";
}

TEST(CounterCheck, SaysThatAnArmStandsStillIfNoMotorMovesByMoreThanThreeCounts) {
  const auto stands_still = [](double resolution, double way) {
    ArmModel model = first_joints(1);
    model.nominal.joint[0].motor_encoder_resolution = resolution;
    Log log(1);
    for (int i = 0; i < 300; ++i) {
      log.time.push_back(1e-3 * i);
      log.motor_position[0].push_back(i % 2 == 0 ? 0 : way);
    }
    const std::vector<LogFinding> findings = found_by(check_counters, log, model);
    return findings.size() == 1 && findings[0].stands_still;
  };
  EXPECT_TRUE(stands_still(0.01, 0.029));
  EXPECT_FALSE(stands_still(0.01, 0.031));
  // With fine counts it is a ten-thousandth of the joint's range: 0.0214 rad of the motor.
  EXPECT_TRUE(stands_still(1e-3, 0.021));
  EXPECT_FALSE(stands_still(1e-3, 0.022));
}

TEST(ColumnCheck, TellsHowLongAPositionStandsStillWhileTheOtherOneMoves) {
  const ArmModel model = first_joints(1);
  const Log moving = log_along(3, 1000, [](double t) { return 0.2 + 0.4 * t; });
  const auto told = [&](Signals Log::*signal) {
    Log log = moving;
    std::vector<double>& x = (log.*signal)[0];
    // In the last one the joint moves by less than a twentieth of its range.
    for (const auto& [from, to] : {std::pair(500, 800), std::pair(1500, 2000), std::pair(2400, 2550)}) {
      const double held = x[from];
      for (int i = from; i <= to; ++i) x[i] = held;
    }
    const std::vector<LogFinding> findings = found_by(check_columns, log, model);
    return findings.size() == 1 ? findings[0].what : lines_of(findings);
  };
  EXPECT_EQ(told(&Log::joint_position),
            "stands still for 0.8 s while the motor moves, longest from 1.5 to 2 s; the sensor is stuck or not "
            "connected");
  EXPECT_EQ(told(&Log::motor_position),
            "stands still for 0.8 s while the joint moves, longest from 1.5 to 2 s; expected the angle of the motor");
}

TEST(ColumnCheck, TellsHowOftenAndHowLongAMotorStopsAbruptlyAtItsExtreme) {
  const auto told = [](int stops) {
    Log log(1);
    for (int i = 0; i < 1000 * stops; ++i) {
      const int phase = i % 1000;
      log.time.push_back(1e-3 * i);
      log.motor_position[0].push_back(std::min({60 + 0.1 * phase, 100.0, 100 - 0.1 * (phase - 599)}));
    }
    return lines_of(found_by(check_columns, log, first_joints(1)));
  };
  EXPECT_EQ(told(1), "") << "once may be by chance";
  const std::string three = told(3);
  EXPECT_NE(three.find("motor_position_1: stops abruptly at its extreme value 100 3 times, for 0.597 s together: a "
                       "counter or converter at its end"),
            std::string::npos)
      << three;
}

/// What is told of a torque of up to 1 N m that stays at 2 N m so many times for so many samples of 1000.
std::string told_of_stopping_torque(int times, int samples, double limit_of_model = 0) {
  ArmModel model = first_joints(1);
  model.joints[0].controller.torque_limit = limit_of_model;
  Log log(1);
  for (int i = 0; i < 1000; ++i) log.time.push_back(1e-3 * i), log.motor_torque[0].push_back(std::sin(0.1 * i));
  for (int t = 0; t < times; ++t)
    for (int s = 0; s < samples; ++s) log.motor_torque[0][10 + 30 * t + s] = 2;
  const std::vector<LogFinding> findings = found_by(check_clipped_torques, log, model);
  return findings.size() == 1 ? findings[0].what : lines_of(findings);
}

TEST(TorqueCheck, TakesATorqueForClippedThatStaysAtItsExtremeInAHundredthOfTheSamples) {
  EXPECT_EQ(told_of_stopping_torque(10, 5), "is exactly 2 in 5 % of the samples, its extreme value: clipped");
  EXPECT_EQ(told_of_stopping_torque(4, 3), "is exactly 2 in 1.2 % of the samples, its extreme value: clipped");
  EXPECT_EQ(told_of_stopping_torque(3, 3), "") << "0.9 %";
  EXPECT_EQ(told_of_stopping_torque(30, 2), "") << "it does not stay for three samples";
}

TEST(TorqueCheck, TakesNoTorqueForClippedThatStopsWithinATwentiethOfTheModelsLimit) {
  EXPECT_EQ(told_of_stopping_torque(10, 5, 2 / 1.04), "");
  EXPECT_EQ(told_of_stopping_torque(10, 5, 2 / 0.96), "");
  EXPECT_NE(told_of_stopping_torque(10, 5, 2 / 1.06), "");
  EXPECT_NE(told_of_stopping_torque(10, 5, 2 / 0.94), "");
}

/// What is told of the zeros of a motor and a joint that stand there. The joint's range is 0 to 1.571 rad.
LogFinding zero_told(double by_motor, std::optional<double> by_joint, bool motor_zero_known = true) {
  Log log = log_along(1, 100, [=](double) { return by_motor; });
  if (by_joint) log.joint_position[0].assign(log.size(), *by_joint);
  else log.joint_position[0].clear();
  ArmModel model = first_joints(1);
  model.nominal.joint[0].motor_zero_known = motor_zero_known;
  const std::vector<LogFinding> findings = found_by(check_zeros, log, model);
  EXPECT_LE(findings.size(), 1u) << lines_of(findings);
  return findings.empty() ? LogFinding{} : findings[0];
}

TEST(ZeroCheck, TellsAReadingThatIsFartherFromWhatTheMotorSaysThanAnEffectReaches) {
  const LogFinding off = zero_told(0.6, 1.6);
  EXPECT_EQ(off.column, "joint_position_1");
  EXPECT_EQ(off.what,
            "is 1.6 rad (91.67 deg) in the median where the motors say 0.6 rad (34.38 deg); the joint's range is 0 to "
            "1.571 rad (0 to 90 deg)");
  EXPECT_EQ(off.remedy,
            "if its zero is wrong, state joint_offset=\"unknown\" in <encoders> of joint 1, or correct it with " +
                option("joint_position_1", "offset=-1") +
                "; if the motor's is, state motor_offset=\"unknown\" there, or correct its zero with " +
                option("motor_position_1", "offset=136.196"));
  EXPECT_NE(zero_told(0.6, 1.11).what, "");
  EXPECT_EQ(zero_told(0.6, 1.09).what, "") << "an encoder_offset reaches 0.5 rad";
}

// The motors that count from where they were switched on: each zero by the joints' sensors, not by the other motors.
TEST(ZeroCheck, TellsTheZeroOfEachMotorAlthoughTheOthersAreWrongToo) {
  Log log = right_log();
  std::vector<double> first;
  for (std::vector<double>& column : log.motor_position) {
    first.push_back(column.front());
    for (double& x : column) x -= first.back();
  }
  const std::vector<LogFinding> findings = check_log(log, raven());
  ASSERT_EQ(findings.size(), 3u) << lines_of(findings);
  for (int k = 0; k < 3; ++k) {
    const std::string key = numbered("--column motor_position_", k) + numbered("=motor_position_", k) + ",offset=";
    const std::size_t at = findings[k].remedy.find(key);
    ASSERT_NE(at, std::string::npos) << lines_of(findings);
    // But for the stretch of the cables, 2 rad at the motor.
    EXPECT_NEAR(std::stod(findings[k].remedy.substr(at + key.size())), first[k], 2) << k;
    EXPECT_NE(findings[k].remedy.find("motor_offset=\"unknown\""), std::string::npos);
  }
}

TEST(ZeroCheck, TellsASensorOutsideTheRangeAlsoIfItGivesTheMotorsZero) {
  const LogFinding off = zero_told(0.6, 2.1, false);
  EXPECT_EQ(off.column, "joint_position_1");
  EXPECT_EQ(off.what, "is 2.1 rad (120.3 deg) in the median, outside the joint's range, 0 to 1.571 rad (0 to 90 deg)");
  EXPECT_EQ(zero_told(0.6, 1.9, false).what, "");
  EXPECT_EQ(zero_told(5, std::nullopt, false).what, "");
}

TEST(ZeroCheck, TellsAMotorThatPutsItsJointAQuarterOfARangeOutside) {
  EXPECT_EQ(zero_told(2.1, 0.6).what,
            "puts joint 1 at 2.1 rad (120.3 deg) in the median; its sensor says 0.6 rad (34.38 deg), its range is 0 to "
            "1.571 rad (0 to 90 deg)");
  EXPECT_EQ(zero_told(2.1, std::nullopt).what,
            "puts joint 1 at 2.1 rad (120.3 deg) in the median, outside its range, 0 to 1.571 rad (0 to 90 deg)");
  EXPECT_EQ(zero_told(1.9, std::nullopt).what, "");
}

TEST(ZeroCheck, TellsBetweenWhichOffsetsTheMotionOfAMotorFitsIntoTheRange) {
  // It may stand anywhere from 0 to 1.571 rad: 2.1 rad less by 0.529 to 2.1 rad. One rad of the motor is 7.343 mrad.
  EXPECT_EQ(
      zero_told(2.1, std::nullopt).remedy,
      "check the sign and the zero of this column, or the range in the model; the motion fits into the range with "
      "an offset of -286 to -72.08 rad: hold the joint at a known position to measure it, or begin with the "
      "middle, " +
          option("motor_position_1", "offset=-179.044"));
}

TEST(ZeroCheck, PutsTheMiddleOfAMotionThatIsWiderThanTheRangeIntoItsMiddle) {
  // From 1.3 to 3.3 rad; the range is 0 to 1.571 rad.
  Log log = log_along(4, 100, [](double t) { return 2.3 - std::cos(1.7 * t); });
  log.joint_position[0].clear();
  const std::vector<LogFinding> findings = found_by(check_zeros, log, first_joints(1));
  ASSERT_EQ(findings.size(), 1u) << lines_of(findings);
  EXPECT_NE(findings[0].remedy.find("the motion is wider than the range; its middle is in that of the range with " +
                                    option("motor_position_1", "offset=-206.")),
            std::string::npos)
      << findings[0].remedy;
}

TEST(DelayCheck, TellsByHowMuchASensorIsLateOrAhead) {
  const ArmModel model = first_joints(1);
  const auto told = [&](double late) {
    Log log = log_along(2, 500, slow_swing);
    for (std::size_t i = 0; i < log.size(); ++i) log.joint_position[0][i] = slow_swing(log.time[i] - late);
    const std::vector<LogFinding> findings = found_by(check_delays, log, model);
    return findings.size() == 1 ? findings[0].what : lines_of(findings);
  };
  EXPECT_EQ(told(0.04), "is 40 ms late against motor_position_1; the shift removes 100 % of the squared mismatch");
  EXPECT_EQ(told(-0.04), "is 40 ms ahead of motor_position_1; the shift removes 100 % of the squared mismatch");
  // Three sample intervals are 6 ms.
  EXPECT_EQ(told(0.007), "is 7 ms late against motor_position_1; the shift removes 100 % of the squared mismatch");
  EXPECT_EQ(told(0.005), "");
}

TEST(DelayCheck, TellsThatASlowSensorIsLaterThanADiagnosisCanMeasure) {
  const ArmModel model = first_joints(1);
  const auto told = [&](double late) {
    Log log = log_along(6, 500, slow_swing);
    for (std::size_t i = 0; i < log.size(); ++i)
      log.joint_position[0][i] = i % 16 == 0 ? slow_swing(log.time[i] - late) : std::nan("");
    return lines_of(found_by(check_delays, log, model));
  };
  const std::string line = told(0.12);
  EXPECT_NE(line.find("joint_position_1: is 120 ms late against motor_position_1"), line.npos) << line;
  EXPECT_NE(line.find("a diagnosis measures and takes out at most 0.1 s"), line.npos) << line;
  EXPECT_EQ(told(0.06), "");
  EXPECT_EQ(told(0), "");
}

}  // namespace
}  // namespace halyard

/// Single checks of a log, on logs that are made by hand or changed in one column.

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/clock_check.h"
#include "tests/support/checked_logs.h"
#include "tests/support/message_of.h"

namespace halyard {
namespace {

/// The findings of one check.
std::vector<LogFinding> found_by(void (*check)(LogUnderCheck&), const Log& log, const ArmModel& model) {
  const LogCheckRule rule;
  LogUnderCheck c(log, model, {}, rule);
  check(c);
  return c.findings;
}

TEST(TimeCheck, ProposesNoUnitInWhichTheLogWouldBeTooShort) {
  Log log(1);
  for (int i = 0; i < 600; ++i) log.time.push_back(0.2 * i);  // 0.12 s if these were milliseconds
  const std::vector<LogFinding> findings = check_times(log, first_joints(1), {});
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].what.find("looks like"), std::string::npos) << findings[0].what;
  EXPECT_EQ(findings[0].remedy, "give the times in s, or a record with at least 10 samples a second");
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
}

TEST(LogFindings, TellTheLineIfTheErrorIsInOne) {
  LogFinding wrong = finding_of("motor_torque_1", Severity::gross);
  wrong.line = 17;
  EXPECT_EQ(finding_line(wrong), "some.csv:17: motor_torque_1: is wrong; mend it");
}

}  // namespace
}  // namespace halyard

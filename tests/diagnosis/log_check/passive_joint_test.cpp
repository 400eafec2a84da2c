/// The check of the reading of a joint without a motor.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/diagnosis/log_check/checked_logs.h"

namespace halyard {
namespace {

/// The right log, as if joint 2 had no motor.
ArmModel with_passive_joint() {
  ArmModel model = raven();
  model.nominal.joint[1].drive = Drive::none;
  return model;
}
Log of_passive_joint(double factor) {
  Log log = scaled(&Log::joint_position, 1, factor);
  log.motor_position[1].clear(), log.motor_torque[1].clear();
  return log;
}

TEST(PassiveJointCheck, FindsNothingInARightLog) {
  EXPECT_EQ(lines_of(found_by(check_positions, of_passive_joint(1), with_passive_joint())), "");
}

TEST(PassiveJointCheck, TellsDegreesFromItsRange) {
  const auto findings = found_by(check_positions, of_passive_joint(180 / M_PI), with_passive_joint());
  ASSERT_EQ(findings.size(), 1u) << lines_of(findings);
  EXPECT_EQ(findings[0].column, "joint_position_2");
  EXPECT_EQ(findings[0].severity, Severity::gross);
  EXPECT_NE(findings[0].what.find("times its range, as if it were in degrees"), std::string::npos) << findings[0].what;
  EXPECT_EQ(findings[0].remedy, "read it with " + option("joint_position_2", "unit=deg"));
}

TEST(PassiveJointCheck, AsksForTheRangeIfNoUnitExplainsTheWidth) {
  const auto findings = found_by(check_positions, of_passive_joint(7), with_passive_joint());
  ASSERT_EQ(findings.size(), 1u) << lines_of(findings);
  EXPECT_EQ(findings[0].severity, Severity::suspicious);
  EXPECT_EQ(findings[0].remedy, "correct the range of joint 2 in the model, or give the column its unit");
}

TEST(PassiveJointCheck, TellsAReversedReadingFromItsRange) {
  const auto findings = found_by(check_positions, of_passive_joint(-1), with_passive_joint());
  ASSERT_EQ(findings.size(), 1u) << lines_of(findings);
  EXPECT_EQ(findings[0].severity, Severity::suspicious);
  EXPECT_NE(findings[0].remedy.find("; within the range with " + option("joint_position_2", "sign=-1")),
            std::string::npos)
      << findings[0].remedy;
}

}  // namespace
}  // namespace halyard

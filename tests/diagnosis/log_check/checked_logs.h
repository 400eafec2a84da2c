#pragma once
/// Logs for the tests of the log check: a right one of the RAVEN-II, changes of it, and what the check finds.

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/log_check.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {

using Severity = LogFinding::Severity;
inline constexpr double kCheckedDuration = 6;  // s

inline const ArmModel& raven() {
  static const ArmModel model = first_joints(3);
  return model;
}

/// All joints in motion; the prismatic one within its smaller range.
inline Scenario small_motion(const ArmModel& robot) {
  Scenario s = motion(robot, kCheckedDuration);
  for (int k = 0; k < robot.n(); ++k)
    if (robot.nominal.joint[k].type == JointType::prismatic)
      for (Sine& sine : s.trajectory[k].sines) sine.amplitude *= 0.3;
  return s;
}

/// A right log of the RAVEN-II's three joints, simulated once.
inline const Log& right_log() {
  static const Log log = [] {
    Log simulated = simulate(small_motion(raven())).measured;
    simulated.source = "rig.csv";
    return simulated;
  }();
  return log;
}

inline std::string lines_of(const std::vector<LogFinding>& findings) {
  std::string text;
  for (const LogFinding& f : findings) text += std::string(severity_word(f.severity)) + ": " + finding_line(f) + "\n";
  return text;
}

inline void expect_right(const Log& log, const ArmModel& model, const std::string& of = "") {
  EXPECT_EQ(lines_of(check_log(log, model)), "") << of;
}

/// Expects one finding about the column, with these words in it.
inline void expect_one(const Log& log, const std::string& column, Severity severity,
                       const std::vector<std::string>& parts, const ArmModel& model = raven()) {
  const std::vector<LogFinding> findings = check_log(log, model);
  ASSERT_EQ(findings.size(), 1u) << column << "\n" << lines_of(findings);
  EXPECT_EQ(findings[0].column, column) << lines_of(findings);
  EXPECT_EQ(findings[0].severity, severity) << lines_of(findings);
  for (const std::string& part : parts)
    EXPECT_NE(finding_line(findings[0]).find(part), std::string::npos) << part << "\n" << lines_of(findings);
}

/// The findings of one check.
inline std::vector<LogFinding> found_by(void (*check)(LogUnderCheck&), const Log& log, const ArmModel& model) {
  const LogCheckRule rule;
  LogUnderCheck c(log, model, {}, rule);
  check(c);
  return c.findings;
}

inline Log changed(Signals Log::*signal, int k, const std::function<double(double)>& change) {
  Log log = right_log();
  for (double& x : (log.*signal)[k]) x = change(x);
  return log;
}

inline Log scaled(Signals Log::*signal, int k, double factor) {
  return changed(signal, k, [=](double x) { return factor * x; });
}

inline Log without_joint_sensors(Log log) {
  for (auto& column : log.joint_position) column.clear();
  return log;
}

inline std::string option(const std::string& column, const std::string& rest) {
  return "--column " + column + "=" + column + "," + rest;
}

inline std::string numbered(const char* name, int k) { return name + std::to_string(k + 1); }

// --------------------------------------------------------------------------------------------- signs

}  // namespace halyard

/// Logs with one error each, and right logs of arms with and without effects: the check names the column and a remedy
/// that mends it, and finds nothing in a right log.

#include "diagnosis/log_check/log_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "diagnosis/diagnose.h"
#include "model/arm_log.h"
#include "plant/simulate.h"
#include "tests/support/message_of.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

using Severity = LogFinding::Severity;
namespace fs = std::filesystem;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kDuration = 6;  // s

const ArmModel& raven() {
  static const ArmModel model = first_joints(3);
  return model;
}

/// All joints in motion; the prismatic one within its smaller range.
Scenario small_motion(const ArmModel& robot) {
  Scenario s = motion(robot, kDuration);
  for (int k = 0; k < robot.n(); ++k)
    if (robot.nominal.joint[k].type == JointType::prismatic)
      for (Sine& sine : s.trajectory[k].sines) sine.amplitude *= 0.3;
  return s;
}

/// A right log of the RAVEN-II's three joints, simulated once.
const Log& right_log() {
  static const Log log = [] {
    Log simulated = simulate(small_motion(raven())).measured;
    simulated.source = "rig.csv";
    return simulated;
  }();
  return log;
}

std::string lines_of(const std::vector<LogFinding>& findings) {
  std::string text;
  for (const LogFinding& f : findings) text += std::string(severity_word(f.severity)) + ": " + finding_line(f) + "\n";
  return text;
}

void expect_right(const Log& log, const ArmModel& model, const std::string& of = "") {
  EXPECT_EQ(lines_of(check_log(log, model)), "") << of;
}

/// Expects one finding about the column, with these words in it.
void expect_one(const Log& log, const std::string& column, Severity severity, const std::vector<std::string>& parts,
                const ArmModel& model = raven()) {
  const std::vector<LogFinding> findings = check_log(log, model);
  ASSERT_EQ(findings.size(), 1u) << column << "\n" << lines_of(findings);
  EXPECT_EQ(findings[0].column, column) << lines_of(findings);
  EXPECT_EQ(findings[0].severity, severity) << lines_of(findings);
  for (const std::string& part : parts)
    EXPECT_NE(finding_line(findings[0]).find(part), std::string::npos) << part << "\n" << lines_of(findings);
}

Log changed(Signals Log::*signal, int k, const std::function<double(double)>& change) {
  Log log = right_log();
  for (double& x : (log.*signal)[k]) x = change(x);
  return log;
}

Log scaled(Signals Log::*signal, int k, double factor) {
  return changed(signal, k, [=](double x) { return factor * x; });
}

Log without_joint_sensors(Log log) {
  for (auto& column : log.joint_position) column.clear();
  return log;
}

std::string option(const std::string& column, const std::string& rest) {
  return "--column " + column + "=" + column + "," + rest;
}

std::string numbered(const char* name, int k) { return name + std::to_string(k + 1); }

// --------------------------------------------------------------------------------------------- signs

TEST(LogCheck, NamesAReversedMotor) {
  for (int k = 0; k < 3; ++k)
    expect_one(scaled(&Log::motor_position, k, -1), numbered("motor_position_", k), Severity::gross,
               {"is reversed", option(numbered("motor_position_", k), "sign=-1")});
}

TEST(LogCheck, NamesAReversedJointSensor) {
  for (int k = 0; k < 3; ++k)
    expect_one(scaled(&Log::joint_position, k, -1), numbered("joint_position_", k), Severity::gross,
               {"is reversed", option(numbered("joint_position_", k), "sign=-1")});
}

TEST(LogCheck, NamesAReversedTorque) {
  for (int k = 0; k < 3; ++k)
    expect_one(scaled(&Log::motor_torque, k, -1), numbered("motor_torque_", k), Severity::gross,
               {"opposes", option(numbered("motor_torque_", k), "sign=-1")});
}

TEST(LogCheck, TellsAReversedMotorFromAReversedTorqueWithoutJointSensors) {
  expect_one(without_joint_sensors(scaled(&Log::motor_position, 1, -1)), "motor_position_2", Severity::gross,
             {"outside its range", option("motor_position_2", "sign=-1")});
  expect_one(without_joint_sensors(scaled(&Log::motor_torque, 1, -1)), "motor_torque_2", Severity::gross,
             {option("motor_torque_2", "sign=-1")});
}

TEST(LogCheck, RepeatsTheScaleAndOffsetThatTheColumnHasAlready) {
  ColumnMap columns;
  columns.add("joint_position_2", "elbow", "deg", 1, 1, 0.1);
  const std::vector<LogFinding> findings = check_log(scaled(&Log::joint_position, 1, -1), raven(), columns);
  ASSERT_EQ(findings.size(), 1u) << lines_of(findings);
  EXPECT_NE(findings[0].remedy.find("--column joint_position_2=elbow,unit=deg,sign=-1,offset=-0.1"), std::string::npos)
      << findings[0].remedy;
}

// --------------------------------------------------------------------------------------------- units

TEST(LogCheck, NamesTheUnitOfAJointSensor) {
  expect_one(scaled(&Log::joint_position, 0, 1 / kDegree), "joint_position_1", Severity::gross,
             {"degrees", option("joint_position_1", "unit=deg")});
  expect_one(scaled(&Log::joint_position, 2, 1e3), "joint_position_3", Severity::gross,
             {"millimetres", option("joint_position_3", "unit=mm")});
  const double resolution = raven().nominal.joint[1].joint_encoder_resolution;
  expect_one(scaled(&Log::joint_position, 1, 1 / resolution), "joint_position_2", Severity::gross,
             {"counts of its encoder", "scale=7.85398e-05"});
}

TEST(LogCheck, NamesTheUnitOfAMotor) {
  for (int k = 0; k < 3; ++k) {
    const std::string column = numbered("motor_position_", k);
    expect_one(scaled(&Log::motor_position, k, 1 / kDegree), column, Severity::gross, {option(column, "unit=deg")});
    expect_one(scaled(&Log::motor_position, k, 1 / 12.25), column, Severity::gross,
               {"behind the gear", option(column, "scale=12.25")});
    expect_one(without_joint_sensors(scaled(&Log::motor_position, k, 1 / kDegree)), column, Severity::gross,
               {"times its range", option(column, "unit=deg")});
  }
}

TEST(LogCheck, NamesTheUnitOfATorque) {
  for (int k = 0; k < 3; ++k) {
    const std::string column = numbered("motor_torque_", k);
    expect_one(scaled(&Log::motor_torque, k, 1e3), column, Severity::gross, {"mN m", option(column, "unit=mN.m")});
    expect_one(scaled(&Log::motor_torque, k, 12.25), column, Severity::gross,
               {"behind the gear", option(column, "scale=0.0816327")});
  }
}

TEST(LogCheck, SuspectsARatioThatNoUnitExplains) {
  expect_one(scaled(&Log::joint_position, 0, 1.8), "joint_position_1", Severity::suspicious, {"1.8", "gear_ratio"});
}

TEST(LogCheck, CorrectsAReversedMotorBeforeItChecksTheNextColumn) {
  Log log = scaled(&Log::motor_position, 0, -1);
  for (double& q : log.joint_position[1]) q /= kDegree;
  const std::vector<LogFinding> findings = check_log(log, raven());
  ASSERT_EQ(findings.size(), 2u) << lines_of(findings);
  EXPECT_EQ(findings[0].column, "joint_position_2");
  EXPECT_EQ(findings[1].column, "motor_position_1");
}

// ----------------------------------------------------------------------------------- zeros and swaps

TEST(LogCheck, SuspectsAZeroThatIsFarOff) {
  expect_one(changed(&Log::joint_position, 0, [](double q) { return q + 2; }), "joint_position_1", Severity::suspicious,
             {"correct its zero", "offset=-2"});
  expect_one(changed(&Log::motor_position, 1, [](double q) { return q - 200; }), "motor_position_2",
             Severity::suspicious, {"motor_offset=\"unknown\""});
  expect_right(changed(&Log::joint_position, 0, [](double q) { return q + 0.1; }), raven(), "an effect");
}

TEST(LogCheck, NamesSwappedColumns) {
  for (const auto& [signal, name] :
       {std::pair(&Log::motor_position, "motor_position_"), std::pair(&Log::joint_position, "joint_position_"),
        std::pair(&Log::motor_torque, "motor_torque_")})
    for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2)}) {
      Log log = right_log();
      std::swap((log.*signal)[i], (log.*signal)[j]);
      const std::string a = numbered(name, i), b = numbered(name, j);
      expect_one(log, a, Severity::gross,
                 {"exchanged with " + b, "--column " + a + "=" + b + " --column " + b + "=" + a});
    }
}

// -------------------------------------------------------------------------------------------- clocks

TEST(LogCheck, NamesTimesThatDoNotIncrease) {
  Log log = right_log();
  log.time[100] = log.time[99];
  expect_one(log, "time", Severity::gross, {"in sample 101", "do not increase"});
  for (std::size_t i = 500; i < log.size(); ++i) log.time[i] -= 3;
  expect_one(log, "time", Severity::gross, {"the first of 2 times"});
}

TEST(LogCheck, NamesTimesInMillisecondsAndMicroseconds) {
  for (const auto& [factor, unit] : {std::pair(1e3, "unit=ms"), std::pair(1e6, "unit=us")}) {
    Log log = right_log();
    for (double& t : log.time) t *= factor;
    expect_one(log, "time", Severity::gross, {option("time", unit)});
  }
}

TEST(LogCheck, ReportsMissingRowsAndJitter) {
  Log log = slice(right_log(), 0, 1);
  for (std::size_t i = 1; i < right_log().size(); ++i) {
    if (i > 2000 && i < 2050) continue;
    const Log row = slice(right_log(), i, i + 1);
    log.time.push_back(row.time[0]);
    for (const auto signal : {&Log::motor_torque, &Log::motor_position, &Log::joint_position})
      for (int k = 0; k < 3; ++k) (log.*signal)[k].push_back((row.*signal)[k][0]);
  }
  expect_one(log, "time", Severity::suspicious, {"49 rows are missing in 1 gaps"});
  log = right_log();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> late(0, 0.8e-3);
  for (double& t : log.time) t += late(random);
  expect_one(log, "time", Severity::suspicious, {"jitters"});
}

TEST(LogCheck, SuspectsASensorThatIsLate) {
  Log log = right_log();
  std::vector<double>& q = log.joint_position[1];
  q.insert(q.begin(), 40, q.front());
  q.resize(log.size());
  expect_one(log, "joint_position_2", Severity::suspicious, {"ms late against motor_position_2", "delay"});
}

// ------------------------------------------------------------------------------------------- sensors

TEST(LogCheck, FindsASensorThatFreezes) {
  ASSERT_EQ(right_log().size(), 6001u);
  for (const auto& [from, to] : {std::pair(0, 6001), std::pair(2000, 3500)}) {
    Log log = right_log();
    for (int i = from; i < to; ++i) log.joint_position[0][i] = log.joint_position[0][from];
    expect_one(log, "joint_position_1", Severity::suspicious, {from == 0 ? "never changes" : "stands still for"});
    log = right_log();
    for (int i = from; i < to; ++i) log.motor_position[0][i] = log.motor_position[0][from];
    expect_one(log, "motor_position_1", Severity::gross, {from == 0 ? "never changes" : "stands still for"});
  }
}

TEST(LogCheck, FindsAMotorThatFreezesWithoutJointSensorsByItsJump) {
  Log log = without_joint_sensors(right_log());
  for (int i = 2000; i < 2600; ++i) log.motor_position[0][i] = log.motor_position[0][2000];
  expect_one(log, "motor_position_1", Severity::suspicious, {"jumps by"});
}

TEST(LogCheck, CountsOutliers) {
  Log log = right_log();
  for (const std::size_t i : {700, 2100, 4400}) log.joint_position[1][i] += 0.02;
  expect_one(log, "joint_position_2", Severity::suspicious, {"3 single samples"});
}

TEST(LogCheck, NamesACounterThatWrapsAround) {
  const double period = 32 * std::numbers::pi;
  expect_one(changed(&Log::motor_position, 0, [=](double q) { return q - period * std::floor(q / period); }),
             "motor_position_1", Severity::gross, {"16 turns", "unwrap"});
  const double counts = 16384 * raven().nominal.joint[2].joint_encoder_resolution;
  expect_one(changed(&Log::joint_position, 2, [=](double q) { return q - counts * std::floor(q / counts); }),
             "joint_position_3", Severity::gross, {"2^14 counts"});
}

TEST(LogCheck, SuspectsClippedSignals) {
  const std::vector<double>& torque = right_log().motor_torque[1];
  const double limit = 0.5 * *std::ranges::max_element(torque);
  expect_one(changed(&Log::motor_torque, 1, [=](double t) { return std::min(t, limit); }), "motor_torque_2",
             Severity::suspicious, {"clipped"});
}

TEST(LogCheck, RejectsARobotThatIsSwitchedOff) {
  Log log = right_log();
  for (const auto signal : {&Log::motor_torque, &Log::motor_position, &Log::joint_position})
    for (auto& column : log.*signal) std::ranges::fill(column, signal == &Log::motor_torque ? 0 : column[0]);
  expect_one(log, "motor_position_1", Severity::gross, {"switched off", "nothing to learn from"});
  for (double& t : log.motor_torque[1]) t = 0.01;
  expect_one(log, "motor_position_1", Severity::gross, {"torque is commanded and no motor moves"});
}

// ------------------------------------------------------------------------------------- the diagnosis

TEST(Diagnose, StopsAtAReversedMotorAndNamesTheColumn) {
  const std::string message =
      message_of([] { diagnose(raven(), {scaled(&Log::motor_position, 1, -1)}, std::nullopt); });
  EXPECT_TRUE(message.starts_with("rig.csv: motor_position_2: is reversed")) << message;
  EXPECT_NE(message.find(option("motor_position_2", "sign=-1")), std::string::npos) << message;
}

// ---------------------------------------------------------------------------------------- right logs

/// A log as poor sensors write it: noisy; joints at 50 Hz, empty between or holding the last reading.
Log with_poor_sensors(Log log, unsigned seed, bool hold) {
  std::mt19937 random(seed);
  std::normal_distribution<double> unit(0, 1);
  for (int k = 0; k < log.n_joints; ++k) {
    for (double& t : log.motor_torque[k]) t += 1e-3 * unit(random);
    double last = 0;
    for (std::size_t i = 0; i < log.joint_position[k].size(); ++i) {
      double& q = log.joint_position[k][i];
      if (i % 20 == 0) last = q + (k == 2 ? 30e-6 : 0.3e-3) * unit(random);
      q = i % 20 == 0 || hold ? last : kNan;
    }
  }
  return log;
}

TEST(LogCheck, FindsNothingInARightLogWhateverItsSensors) {
  expect_right(right_log(), raven());
  expect_right(without_joint_sensors(right_log()), raven());
  expect_right(with_poor_sensors(right_log(), 1, false), raven());
  expect_right(with_poor_sensors(right_log(), 2, true), raven());
  Log log = right_log();
  for (auto& column : log.motor_torque) column.clear();
  expect_right(log, raven());
  log = right_log();
  for (double& t : log.motor_torque[0]) t = 0;
  expect_right(log, raven(), "a torque that was not recorded");
}

TEST(LogCheck, FindsNothingInALogOfLargeEffects) {
  const auto with = [](const std::string& name, EffectPlace joint, const std::vector<double>& p) {
    ArmModel truth = raven();
    truth.effects.push_back(place_neutral_effect(*find_effect(name), truth.nominal, joint));
    std::copy(p.begin(), p.end(), truth.effects[0].p);
    expect_right(simulate(small_motion(truth)).measured, raven(), name);
  };
  with("capstan_ratio", 0, {1.056});
  with("backlash", 1, {5e-4});
  with("payload", kWholeArm, {0.3});
  with("motor_friction", 2, {3 * raven().nominal.joint[2].motor_coulomb});
  with("encoder_offset", 1, {0.05});
}

/// The RAVEN-II's chain with other numbers: ratios, masses, friction and cables by a factor of up to two each.
ArmModel other_arm(std::mt19937& random, int n) {
  std::uniform_real_distribution<double> log_factor(-std::log(2.0), std::log(2.0));
  ArmModel model = first_joints(n);
  for (int k = 0; k < n; ++k) {
    JointParameters<double>& j = model.nominal.joint[k];
    const double mass = std::exp(log_factor(random));
    j.mass *= mass;
    for (double& moment : j.inertia) moment *= mass;
    for (double* number : {&j.gear_ratio, &j.motor_coulomb, &j.joint_coulomb, &j.stiffness})
      *number *= std::exp(log_factor(random));
    j.damping = j.stiffness * model.nominal.joint[k].damping / first_joints(n).nominal.joint[k].stiffness;
    model.joints[k].controller.torque_limit = 0;
  }
  return model;
}

TEST(LogCheck, FindsNothingInRandomMotionsOfRandomArms) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 12; ++trial) {
    const ArmModel model = other_arm(random, 1 + trial % 3);
    Scenario s = motion(model, 5);
    for (int k = 0; k < model.n(); ++k) {
      const double range = model.joints[k].upper - model.joints[k].lower;
      for (Sine& sine : s.trajectory[k].sines)
        sine = {range * (0.05 + 0.08 * unit(random)), 0.15 + unit(random), 6 * unit(random)};
    }
    const Log log = simulate(s).measured;
    expect_right(log, model, "trial " + std::to_string(trial));
    expect_right(with_poor_sensors(log, trial, trial % 2 == 0), model, "poor sensors, trial " + std::to_string(trial));
  }
}

/// Checks all logs of a folder of recordings. Skips if the folder is not there.
void expect_right_folder(const std::string& folder, const std::string& model_file,
                         const std::string& of_name_with = "") {
  const fs::path all = fs::path(HALYARD_SHARED_DATA) / folder;
  if (!fs::exists(all)) GTEST_SKIP() << "no recordings at " << all;
  const ArmModel model = read_model(fs::path(HALYARD_SOURCE_DIR) / "examples" / model_file);
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(all)) {
    if (entry.path().extension() != ".csv") continue;
    if (entry.path().filename().string().find(of_name_with) == std::string::npos) continue;
    expect_right(read_log_of(model, entry.path(), {}, false), model);
    ++count;
  }
  EXPECT_GT(count, 0);
}

TEST(LogCheckOnRecordings, FindsNothingOnTheIndependentSimulator) { expect_right_folder("rig", "raven2/raven2.xml"); }
TEST(LogCheckOnRecordings, FindsNothingOnTheCases) { expect_right_folder("cases", "raven2/raven2.xml"); }
TEST(LogCheckOnRecordings, FindsNothingOnTheRaven) {
  expect_right_folder("raven2_motor_log", "measured/raven2_motor_log/raven2.xml");
}
TEST(LogCheckOnRecordings, FindsNothingOnTheScrew) { expect_right_folder("emps", "measured/emps/emps.xml"); }
TEST(LogCheckOnRecordings, FindsNothingOnTheRobotArm) {
  for (const char* axis : {"axis1", "axis2", "axis3"})
    expect_right_folder("kuka_kr300", "measured/kuka_kr300/" + std::string(axis) + ".xml", axis);
}
TEST(LogCheckOnRecordings, FindsNothingOnTheInstrumentInThePoseOfItsModel) {
  expect_right_folder("davinci_tool", "measured/davinci_tool/davinci_tool.xml", "run_L4");
}

TEST(LogCheckOnRecordings, FindsThatThePitchOfAWristMovesTheZeroOfAJaw) {
  const fs::path run = fs::path(HALYARD_SHARED_DATA) / "davinci_tool/run_pitch0_003.csv";
  if (!fs::exists(run)) GTEST_SKIP() << "no recording at " << run;
  const ArmModel model = read_model(HALYARD_SOURCE_DIR "/examples/measured/davinci_tool/davinci_tool.xml");
  expect_one(read_log_of(model, run, {}, false), "joint_position_1", Severity::suspicious, {"correct its zero"}, model);
}

}  // namespace
}  // namespace halyard

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

#include "diagnosis/diagnose.h"
#include "model/arm_log.h"
#include "plant/simulate.h"
#include "tests/diagnosis/log_check/checked_logs.h"
#include "tests/support/message_of.h"
#include "tests/support/short_arm.h"
#include "tests/support/small_arm.h"

namespace halyard {
namespace {

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

TEST(LogCheck, NamesASingleTorqueOfAnImpossibleSize) {
  Log log = right_log();
  log.motor_torque[1][700] = -1e6;
  expect_one(log, "motor_torque_2", Severity::gross, {"-1e+06 N m at 0.7 s", "correct this cell"});
  for (double& x : log.motor_torque[1]) x *= 1e3;  // all of one size: a unit
  log.motor_torque[1][700] = 0;
  for (const LogFinding& f : check_log(log, raven())) EXPECT_EQ(f.what.find("N m at"), f.what.npos) << finding_line(f);
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

TEST(LogCheck, DoesNotBlameAUnitForWhatNoUnitExplains) {
  const std::vector<LogFinding> findings =
      check_log(without_joint_sensors(scaled(&Log::motor_position, 0, 8)), raven(), {});
  ASSERT_FALSE(findings.empty());
  EXPECT_NE(findings[0].what.find("in another unit"), std::string::npos) << lines_of(findings);
  EXPECT_EQ(findings[0].remedy.find("scale="), std::string::npos) << lines_of(findings);
}

TEST(LogCheck, NamesTheColumnWhoseMapConvertsWhatNeedsNoConversion) {
  for (const auto signal : {&Log::motor_position, &Log::joint_position})
    for (int k = 0; k < 2; ++k) {
      const std::string column = numbered(signal == &Log::motor_position ? "motor_position_" : "joint_position_", k);
      ColumnMap columns;
      columns.add(column, "angle", "deg");
      const std::vector<LogFinding> findings = check_log(scaled(signal, k, kDegree), raven(), columns);
      ASSERT_FALSE(findings.empty()) << column;
      EXPECT_EQ(findings[0].column, column);
      EXPECT_EQ(findings[0].remedy, "read it with --column " + column + "=angle");
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
             {"if its zero is wrong", "offset=-2"});
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

TEST(LogCheck, FindsAJointThatDoesNotFollowItsMotor) {
  Log log = right_log();
  log.motor_position[0] = log.motor_position[1];
  const std::vector<LogFinding> findings = check_log(log, raven());
  ASSERT_FALSE(findings.empty());
  EXPECT_NE(lines_of(findings).find("does not follow motor_position_1"), std::string::npos) << lines_of(findings);
}

TEST(LogCheck, CountsOutliers) {
  Log log = right_log();
  for (const std::size_t i : {700, 2100, 4400}) log.joint_position[1][i] += 0.02;
  expect_one(log, "joint_position_2", Severity::corrected, {"3 readings lie far", "0.02"});
  log = right_log();
  log.motor_torque[2][3000] += 0.5;
  expect_one(log, "motor_torque_3", Severity::corrected, {"1 reading lies far"});
}

TEST(LogCheck, NamesACounterThatWrapsAround) {
  const double period = 32 * std::numbers::pi;
  expect_one(changed(&Log::motor_position, 0, [=](double q) { return q - period * std::floor(q / period); }),
             "motor_position_1", Severity::gross, {"16 turns", option("motor_position_1", "wrap=100.530964915")});
  const double counts = 16384 * raven().nominal.joint[2].joint_encoder_resolution;
  expect_one(changed(&Log::joint_position, 2, [=](double q) { return q - counts * std::floor(q / counts); }),
             "joint_position_3", Severity::gross, {"2^14 counts"});
}

TEST(LogCheck, TakesALostBitForAnOutlierAndNotForTheLapOfACounter) {
  for (const int bit : {10, 12, 14, 16, 18}) {
    Log log = right_log();
    log.joint_position[0][3000] += std::exp2(bit) * raven().nominal.joint[0].joint_encoder_resolution;
    for (const LogFinding& f : check_log(log, raven())) EXPECT_NE(f.severity, Severity::gross) << bit << ": " << f.what;
  }
}

/// The joint moves by more than half of 2^14 counts in one gap, and by nearly a fourth in another.
TEST(LogCheck, TakesNoGapForTheLapOfACounter) {
  Log log = right_log();
  std::vector<double>& q = log.joint_position[0];
  const double period = 16384 * raven().nominal.joint[0].joint_encoder_resolution;
  const auto [low, high] = std::ranges::minmax_element(q);
  const auto [first, last] = std::minmax(low, high);
  ASSERT_GT(*high - *low, 0.53 * period) << "the test shows nothing";
  auto from = q.begin(), to = q.end();
  for (; from != q.end(); ++from) {
    to = std::find_if(from, q.end(), [&](double x) { return std::abs(x - *from) > 0.24 * period; });
    if (to != q.end() && (to < first || from > last)) break;
  }
  ASSERT_NE(from, q.end()) << "the test shows nothing";
  std::fill(first + 1, last, std::numeric_limits<double>::quiet_NaN());
  std::fill(from + 1, to, std::numeric_limits<double>::quiet_NaN());
  for (const LogFinding& f : check_log(log, raven())) EXPECT_NE(f.severity, Severity::gross) << finding_line(f);
}

TEST(LogCheck, NamesAMotorThatWrapsInEachTurn) {
  constexpr double kTurn = 2 * std::numbers::pi;
  for (int k = 0; k < 3; ++k)
    expect_one(changed(&Log::motor_position, k, [=](double q) { return q - kTurn * std::round(q / kTurn); }),
               numbered("motor_position_", k), Severity::gross,
               {"starts again after 1 turn", option(numbered("motor_position_", k), "wrap=6.28318530718")});
}

/// The only finding about a log whose column has that period.
LogFinding finding_with_wrap(const Log& log, const std::string& column, double period, double sign = 1) {
  ColumnMap columns;
  columns.add(column, "counter", "", sign, 1, 0, period);
  const std::vector<LogFinding> findings = check_log(log, raven(), columns);
  EXPECT_EQ(findings.size(), 1u) << lines_of(findings);
  return findings.empty() ? LogFinding{} : findings[0];
}

TEST(LogCheck, NamesTheLapInWhichACounterOfAMotorBegins) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const Log log = changed(&Log::motor_position, 0, [](double q) { return q - 20 * kTurn; });
  const LogFinding f = finding_with_wrap(log, "motor_position_1", kTurn, -1);
  EXPECT_EQ(f.severity, Severity::gross);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "begins 20 laps", f.what);
  EXPECT_PRED_FORMAT2(testing::IsSubstring,
                      "--column motor_position_1=counter,sign=-1,offset=125.663706144,wrap=6.28318530718", f.remedy);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "motor_offset=\"unknown\"", f.remedy);
}

TEST(LogCheck, NamesTheLapInWhichACounterOfAJointBegins) {
  const Log log = changed(&Log::joint_position, 1, [](double q) { return q + 2.5; });
  const LogFinding f = finding_with_wrap(log, "joint_position_2", 2.5);
  EXPECT_EQ(f.severity, Severity::gross);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "--column joint_position_2=counter,offset=-2.5,wrap=2.5", f.remedy);
}

TEST(LogCheck, OnlySuspectsALapThatMayBeAWrongRatio) {
  // One turn of motor 1 moves the joint by 0.046 rad.
  const Log log = changed(&Log::motor_position, 0, [](double q) { return q / 1.056; });
  const LogFinding f = finding_with_wrap(log, "motor_position_1", 2 * std::numbers::pi);
  EXPECT_EQ(f.severity, Severity::suspicious);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "begins 1 lap of its counter", f.what);
}

TEST(LogCheck, FindsTheLapWhereBothSensorsRead) {
  Log log = right_log();
  for (std::size_t i = 0; i < log.size(); ++i)
    if (log.time[i] < 3 || log.time[i] > 4.5) log.joint_position[0][i] = std::numeric_limits<double>::quiet_NaN();
  ColumnMap columns;
  columns.add("motor_position_1", "counter", "", 1, 1, 0, 2 * std::numbers::pi);
  for (const LogFinding& f : check_log(log, raven(), columns))
    EXPECT_EQ(f.what.find("lap"), f.what.npos) << finding_line(f);
}

TEST(LogCheck, TellsTheLapOnTopOfAReversedSign) {
  constexpr double kTurn = 2 * std::numbers::pi;
  ColumnMap columns;
  columns.add("motor_position_1", "counter", "", 1, 1, 0, kTurn);
  const Log log = changed(&Log::motor_position, 0, [](double q) { return -(q - 20 * kTurn); });
  const std::vector<LogFinding> findings = check_log(log, raven(), columns);
  ASSERT_EQ(findings.size(), 2u) << lines_of(findings);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "sign=-1,wrap=6.28", findings[0].remedy);
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "sign=-1,offset=125.66", findings[1].remedy);
}

TEST(LogCheck, ThePeriodGoesWithTheFilesColumnInAnExchange) {
  Log log = right_log();
  std::swap(log.motor_position[0], log.motor_position[1]);
  ColumnMap columns;
  columns.add("motor_position_1", "one", "", 1, 1, 0, 1e4);
  columns.add("motor_position_2", "two");
  const std::vector<LogFinding> findings = check_log(log, raven(), columns);
  ASSERT_FALSE(findings.empty());
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "--column motor_position_1=two --column motor_position_2=one,wrap=10000",
                      findings[0].remedy);
}

TEST(LogCheck, TellsAReadingThatDropsToZeroFromOneThatWraps) {
  Log log = changed(&Log::joint_position, 0, [](double q) { return q + 5; });
  log.joint_position[0][1000] = 0;
  for (const LogFinding& f : check_log(log, raven()))
    EXPECT_EQ(f.what.find("starts again"), f.what.npos) << finding_line(f);
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

TEST(LogCheck, NamesTheFirstMotorOfARobotThatIsSwitchedOff) {
  ArmModel model = raven();
  model.nominal.joint[0].drive = Drive::none;
  Log log = right_log();
  for (const auto signal : {&Log::motor_torque, &Log::motor_position, &Log::joint_position})
    for (auto& column : log.*signal) std::ranges::fill(column, signal == &Log::motor_torque ? 0 : column[0]);
  log.motor_position[0].clear(), log.motor_torque[0].clear();
  const std::vector<LogFinding> findings = check_log(log, model);
  const auto off = std::ranges::find(findings, true, &LogFinding::stands_still);
  ASSERT_NE(off, findings.end());
  EXPECT_EQ(off->column, "motor_position_2");
  EXPECT_NE(off->remedy.find("--column motor_position_2=NAME"), off->remedy.npos) << off->remedy;
}

// ------------------------------------------------------------------------------------- the diagnosis

TEST(Diagnose, StopsAtAReversedMotorAndNamesTheColumn) {
  const std::string message =
      message_of([] { diagnose(raven(), {scaled(&Log::motor_position, 1, -1)}, std::nullopt); });
  EXPECT_TRUE(message.starts_with("rig.csv: motor_position_2: is reversed")) << message;
  EXPECT_NE(message.find(option("motor_position_2", "sign=-1")), std::string::npos) << message;
}

// ---------------------------------------------------------------------------------------- right logs

}  // namespace
}  // namespace halyard

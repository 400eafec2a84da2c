/// Logs as rigs write them, diagnosed: a spoilt log of a right model is no reason to name an effect, and an effect is
/// still found in it.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "diagnosis/diagnose.h"
#include "diagnosis/diagnosis_details.h"
#include "diagnosis/record/record.h"
#include "model/homing.h"
#include "model/input_error.h"
#include "model/model_file.h"
#include "plant/simulate.h"
#include "tests/diagnosis/odd_logs.h"
#include "tests/support/limits.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace halyard {
namespace {

/// EMPS-like: one mass on a screw, rigid, no sensor but the motor's.
ArmModel screw() { return read_model(HALYARD_SOURCE_DIR "/examples/measured/emps/emps.xml"); }

/// Keeps every n-th sample of a column and drops the rest.
void thin(std::vector<double>& column, std::size_t every, std::size_t first = 0) {
  for (std::size_t i = 0; i < column.size(); ++i)
    if (i % every != first) column[i] = kNan;
}

/// Every n-th row of a log, as a slower logger writes it.
Log slower(const Log& log, std::size_t every) {
  Log slow = log;
  const auto keep = [every](std::vector<double>& x) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < x.size(); i += every) x[kept++] = x[i];
    x.resize(kept);
  };
  keep(slow.time);
  for_each_column(slow, [&](const std::string&, std::vector<double>& x) { keep(x); });
  return slow;
}

// ------------------------------------------------------------------------------------------- sensors

TEST(LogWithoutJointSensor, IsClean) {
  expect_clean_of(first_joints(1), [](Log& log) { log.joint_position[0].clear(); });
}

TEST(LogWithoutTorque, IsClean) {
  expect_clean_of(first_joints(1), [](Log& log) { log.motor_torque[0].clear(); });
}

TEST(LogWithATorqueOfZeros, HasNoTorque) {
  expect_clean_of(first_joints(1), [](Log& log) { log.motor_torque[0].assign(log.size(), 0.0); });
}

/// A lost bit in one of the columns now and then.
void add_outliers(Log& log) {
  for (std::size_t i = 300; i + 300 < log.size(); i += 700) {
    log.joint_position[0][i] += 0.05;
    log.motor_position[0][i + 100] -= 8;
    log.motor_torque[0][i + 200] += 0.2;
  }
}

TEST(LogWithOutliers, IsClean) { expect_clean_of(first_joints(1), add_outliers); }
TEST(LogWithOutliers, ShowsTheSameEffect) { expect_larger_of(first_joints(1), add_outliers); }

TEST(LogOfAScrewWithItsMotorAlone, IsCleanAndShowsFrictionOfTheScrew) {
  const ArmModel model = screw();
  ArmModel truth = model;
  truth.nominal.joint[0].motor_coulomb *= 2;
  const auto logs = [](const ArmModel& robot) {
    Scenario s = motion(robot, kLogDuration);
    s.robot.joints[0].controller = {.kp = 4e5, .kd = 1.2e4, .torque_limit = 0};
    s.trajectory[0].center = 0.12;
    s.trajectory[0].sines = {{0.06, 0.4, 0}, {0.02, 1.1, 1}};
    Log log = simulate(s).measured;
    log.joint_position[0].clear();
    return Logs{log, log};
  };
  expect_clean(diagnosis_of(model, logs(model)));
  const Diagnosis d = diagnosis_of(model, logs(truth));
  ASSERT_EQ(d.effects.size(), 1u);
  // Of a rigid drive friction of the joint is friction of the motor; in EMPS's units they are the same number too.
  const std::string name = d.effects[0].effect.effect->name();
  EXPECT_TRUE(name == "motor_friction" || name == "joint_friction") << name;
  const double coulomb = model.nominal.joint[0].motor_coulomb;
  EXPECT_NEAR(d.effects[0].effect.p[0], coulomb, 0.05 * coulomb);
}

TEST(LogWithAMeasuredLoad, IsCleanAndWithoutTheMeasurementNot) {
  ArmModel truth = first_joints(1);
  truth.effects.push_back(placed("external_force", truth, 0, {2.0, 1.0, 4.0}));
  Logs logs = logs_of(truth);
  logs.holdout = clean_logs().holdout;
  EXPECT_NE(diagnosis_of(first_joints(1), logs).verdict, Diagnosis::Verdict::clean);
  for (const double t : logs.train.time) logs.train.joint_torque[0].push_back(t > 1 && t < 4 ? 2.0 : 0.0);
  expect_clean(diagnosis_of(first_joints(1), logs));
}

TEST(Push, IsNamedAlsoIfTheHoldOutHasNone) {
  ArmModel truth = first_joints(1);
  truth.effects.push_back(placed("external_force", truth, 0, {2.0, 4.0, 6.0}));
  constexpr double kDuration = 8;
  Logs logs{simulate(motion(truth, kDuration)).measured, simulate(motion(truth, kDuration, 1)).measured};
  const Diagnosis repeated = diagnosis_of(first_joints(1), logs);
  ASSERT_EQ(repeated.effects.size(), 1u);
  EXPECT_TRUE(repeated.absent_events.empty());
  EXPECT_LT(repeated.after.joint_rms[0], 0.2 * repeated.before.joint_rms[0]);
  logs.holdout = simulate(motion(first_joints(1), kDuration, 1)).measured;
  const Diagnosis once = diagnosis_of(first_joints(1), logs);
  ASSERT_EQ(once.effects.size(), 1u) << "vetoed";
  EXPECT_EQ(once.effects[0].effect.effect->name(), "external_force");
  EXPECT_EQ(once.absent_events, std::vector<std::size_t>{0});
  EXPECT_TRUE(once.revised_on_holdout().effects.empty());
  EXPECT_EQ(once.revised.effects.size(), 1u);
  double widest = 0;
  for (const double half : once.details->joint_view.half_width[0][0]) widest = std::fmax(widest, half);
  EXPECT_LT(widest, 2 * once.joint_interval.half_width[0]) << "no push at that time widens it";
}

TEST(Push, OfOneOfTwoLogsIsToldOnThatLogsClock) {
  ArmModel pushed = first_joints(1);
  pushed.effects.push_back(placed("external_force", pushed, 0, {2.0, 2.0, 3.5}));
  std::vector<Log> training = {clean_logs().train, simulate(motion(pushed, kLogDuration, 2)).measured};
  training[0].source = "first.csv", training[1].source = "second.csv";
  const Diagnosis d = diagnose(first_joints(1), training, clean_logs().holdout, quick());
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects[0].effect.effect->name(), "external_force");
  EXPECT_EQ(d.effects[0].log, "second.csv");
  EXPECT_NEAR(d.effects[0].effect.p[0], 2.0, 0.1);
  // Empirical: an instant is found to 20 ms.
  EXPECT_NEAR(d.effects[0].effect.p[1], 2.0, 0.03);
  EXPECT_NEAR(d.effects[0].effect.p[2], 3.5, 0.03);
  for (const Estimated& p : d.effects[0].parameters)
    if (p.name == "start") {
      EXPECT_TRUE(p.lower < 2.03 && p.upper > 1.97) << p.lower << " to " << p.upper;
    }
  EXPECT_EQ(d.revised.effects[0].p[1], d.effects[0].effect.p[1]);
  EXPECT_TRUE(d.unexplained.empty()) << "nothing happened in the first log";
  const std::vector<Record>& compared = d.details->training;
  ASSERT_EQ(compared.size(), 2u);
  EXPECT_EQ(compared[0].clock_shift, 0);
  EXPECT_NEAR(d.details->attribution.final_fit.hypothesis.effects[0].p[1], 2.0 + compared[1].clock_shift, 0.03);
  EXPECT_GT(compared[1].clock_shift, kLogDuration);
}

TEST(Veto, OfTheHoldOutLeavesWhatTheEffectExplained) {
  const Diagnosis d = diagnosis_of(first_joints(1), {larger_logs().train, clean_logs().holdout});
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::unknown);
  EXPECT_TRUE(d.effects.empty());
  EXPECT_FALSE(d.is_revised());
  ASSERT_EQ(d.unexplained.size(), 2u);
  EXPECT_TRUE(d.unexplained[0].signature.starts_with("capstan_ratio of joint 1 would explain the training data"))
      << d.unexplained[0].signature;
  EXPECT_TRUE(d.unexplained[1].signature.starts_with("the position residual, ")) << d.unexplained[1].signature;
  EXPECT_EQ(d.unexplained[0].kind, Unexplained::Kind::refused);
  EXPECT_EQ(d.unexplained[1].kind, Unexplained::Kind::rest);
}

TEST(MoreFriction, OfMotorAndJointThatStaysIsNoDrift) {
  // `friction_drift` changes both at once, and fits this well without any rate.
  ArmModel truth = first_joints(1);
  truth.nominal.joint[0].motor_coulomb *= 1.6;
  truth.nominal.joint[0].joint_coulomb *= 1.6;
  const Diagnosis d = diagnosis_of(first_joints(1), logs_of(truth));
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_NE(d.effects[0].effect.effect->name(), "friction_drift");
  for (const Alternative& a : d.effects[0].alternatives) EXPECT_NE(a.effect.effect->name(), "friction_drift");
}

TEST(MoreFriction, ThatAlsoFadesALittleIsADrift) {
  // What fades is less than the error of form that is granted to the friction that stays.
  ArmModel truth = first_joints(1);
  truth.effects.push_back(placed("friction_drift", truth, 0, {-0.03, 0.9, 0, 1}));
  const Diagnosis d = diagnosis_of(first_joints(1), logs_of(truth));
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects[0].effect.effect->name(), "friction_drift");
  EXPECT_NEAR(d.effects[0].effect.p[0], -0.03, 0.003);
}

TEST(LogOfMotorsOnly, ChangesNoNumberThatPredictsTheJointsWorse) {
  // Without a joint sensor the training data cannot tell friction of the motor from friction of the joint.
  ArmModel truth = first_joints(1);
  truth.nominal.joint[0].motor_coulomb *= 1.15;
  Logs logs = logs_of(truth);
  logs.train.joint_position[0].clear();
  logs.holdout = simulate(motion(truth, 8, 1)).measured;  // long enough to tell which model is worse
  const Diagnosis d = diagnosis_of(first_joints(1), logs);
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::clean);
  EXPECT_LT(d.after.joint_rms[0], 1.001 * d.before.joint_rms[0]);
  EXPECT_LT(d.after.torque_rms[0], 0.5 * d.before.torque_rms[0]) << "the motor's own friction is refitted";
}

TEST(StuckJointSensor, IsLeftOutAndTold) {
  Logs logs = clean_logs();
  logs.train.joint_position[0].assign(logs.train.size(), 0.7);
  logs.train.source = "rig.csv";
  const Diagnosis d = diagnosis_of(first_joints(1), logs);
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::unknown);
  EXPECT_TRUE(d.effects.empty());
  ASSERT_EQ(d.unexplained.size(), 1u);
  EXPECT_NE(d.unexplained[0].signature.find("stands still in rig.csv while its motor moves"), std::string::npos);
  EXPECT_EQ(d.unexplained[0].kind, Unexplained::Kind::stuck_sensor);
}

// -------------------------------------------------------------------------------- rates and drop-outs

TEST(SlowJointSensor, IsComparedAtItsOwnSamples) {
  expect_clean_of(first_joints(1), [&](Log& log) { thin(log.joint_position[0], 20, 3); });  // 50 Hz in 1 kHz
}

TEST(SlowLog, IsClean) {
  // Without rounding: the controller turns each step of the encoder into a spike of torque, and of those a slow logger
  // takes every tenth.
  Scenario train = motion(first_joints(1), kLogDuration), holdout = motion(first_joints(1), 2.5, 1);
  train.quantise = holdout.quantise = false;
  const Logs logs{simulate(train).measured, simulate(holdout).measured};
  expect_clean(diagnosis_of(first_joints(1), {slower(logs.train, 10), slower(logs.holdout, 10)}));  // 100 Hz
}

TEST(RowsOfEachSensorItsOwn, AreOneLog) {
  // The joint's sensor is read between the others: its cells are empty in their rows, and theirs in its.
  expect_clean_of(first_joints(1), [](Log& log) {
    thin(log.motor_position[0], 2, 0), thin(log.motor_torque[0], 2, 0), thin(log.joint_position[0], 2, 1);
  });
}

TEST(DropOuts, AtRandomAndInBurstsLeaveTheRest) {
  const auto spoil = [](Log& log) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (Signals* s : {&log.motor_position, &log.motor_torque, &log.joint_position})
      for (std::size_t i = 0, burst = 0; i < log.size(); ++i) {
        if (unit(random) < 1e-3) burst = 30;  // ms, once a second
        if (burst > 0 || unit(random) < 0.05) (*s)[0][i] = kNan;
        if (burst > 0) --burst;
      }
  };
  expect_clean_of(first_joints(1), spoil);
  expect_larger_of(first_joints(1), spoil);
}

TEST(SeveralLogs, OfOtherRatesAndSensorsCountTogether) {
  const Logs& logs = larger_logs();
  Log slow_without_torque = slower(logs.train, 4), blind = logs.holdout;
  slow_without_torque.motor_torque[0].clear();
  blind.joint_position[0].clear();
  const Diagnosis d = diagnose(first_joints(1), {slow_without_torque, blind}, logs.holdout, quick());
  expect_named(d, "capstan_ratio", 0, kLargerRatio, 1e-3);
}

// --------------------------------------------------------------------------------------------- clocks

/// The clean logs with a joint sensor that is so many rows of 1 ms late.
Logs logs_with_late_joint(std::size_t rows) {
  Logs logs = clean_logs();
  for (Log* log : {&logs.train, &logs.holdout}) {
    std::vector<double>& q = log->joint_position[0];
    q.insert(q.begin(), rows, q.front());
    q.resize(log->size());
  }
  return logs;
}

TEST(ClockOffsetBetweenSensors, IsNamedDelay) {
  const Logs logs = logs_with_late_joint(8);
  const Diagnosis d = diagnosis_of(first_joints(1), logs);
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects[0].effect.effect->name(), "delay");
  EXPECT_NEAR(d.effects[0].effect.p[1], 8e-3, 0.1e-3) << "a tenth of a sample of the log";
  EXPECT_TRUE(d.unexplained.empty());
}

TEST(ClockOffsetBetweenSensors, OfASlowSensorIsCorrectedAndSaid) {
  Logs logs = logs_with_late_joint(12);
  for (Log* log : {&logs.train, &logs.holdout}) thin(log->joint_position[0], 10);
  const Diagnosis d = diagnosis_of(first_joints(1), logs);
  expect_clean(d);
  ASSERT_EQ(d.log_findings.size(), 2u);  // of both logs
  for (const LogFinding& f : d.log_findings) {
    EXPECT_EQ(f.severity, LogFinding::Severity::corrected) << finding_line(f);
    EXPECT_NE(f.what.find("12 ms late"), std::string::npos) << finding_line(f);
  }
  // A reading in 10 ms.
  const double read_at = d.details->training.at(0).joint_samples.at(0).at(5).time;
  EXPECT_NEAR(std::remainder(read_at + 12e-3, 10e-3), 0, 0.5e-3) << "so the evidence compares what was compared here";
}

TEST(Clock, OfTheUnixEpochAndInMillisecondsIsTheLogsOwn) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "odd_clock.csv";
  const Log& log = clean_logs().train;
  {
    std::ofstream file(path);
    file.precision(17);
    file << "t_ms,motor_torque_1,motor_position_1,joint_position_1\n";
    for (std::size_t i = 0; i < log.size(); ++i)
      file << 1763700000000.0 + 1e3 * log.time[i] << ',' << log.motor_torque[0][i] << ',' << log.motor_position[0][i]
           << ',' << log.joint_position[0][i] << '\n';
  }
  ColumnMap map;
  map.add("time", "t_ms", "ms");
  const Log read = read_log(path, 1, map);
  EXPECT_EQ(read.clock_start, 1763700000.0);
  // Seconds of the epoch as doubles are a quarter of a microsecond apart.
  for (std::size_t i = 0; i < read.size(); i += 100) EXPECT_NEAR(read.time[i], log.time[i], 3e-7);
  expect_clean(diagnosis_of(first_joints(1), {read, clean_logs().holdout}));
  ColumnMap seconds;
  seconds.add("time", "t_ms");
  const std::string message = message_of([&] { make_records(read_log(path, 1, seconds), first_joints(1), {}); });
  EXPECT_NE(message.find("say so by a column map, such as time=NAME,unit=ms"), std::string::npos) << message;
}

// ---------------------------------------------------------------------------------------------- zeros

TEST(EncoderZero, OffByAFewDegreesIsNamed) {
  ArmModel truth = first_joints(1);
  JointParameters<double>& j = truth.nominal.joint[0];
  j.motor_encoder_offset = 0.05 * j.pulley_radius / j.motor_travel();
  expect_named(diagnosis_of(first_joints(1), logs_of(truth)), "encoder_offset", 0, 0.05, 0.02);
}

TEST(UnknownEncoderZero, IsFoundInEachLog) {
  for (const bool motor : {true, false}) {
    ArmModel model = first_joints(1);
    (motor ? model.nominal.joint[0].motor_zero_known : model.nominal.joint[0].joint_zero_known) = false;
    double zero = 40;  // rad, another one in each log
    const auto spoil = [&](Log& log) {
      for (double& reading : motor ? log.motor_position[0] : log.joint_position[0]) reading += zero;
      zero = -0.6 * zero;
    };
    expect_clean_of(model, spoil);
  }
}

TEST(UnknownEncoderZero, CannotBeToldWithoutTheJointsSensor) {
  ArmModel model = first_joints(1);
  model.nominal.joint[0].motor_zero_known = false;
  Log log = clean_logs().train;
  log.source = "rig.csv";
  log.joint_position[0].clear();
  EXPECT_EQ(
      message_of([&] { home_encoders(log, model); }),
      "rig.csv: the model does not know the zero of motor encoder 1 (motor_offset=\"unknown\"), and the log has no "
      "joint_position_1 to tell it; give the joint's sensor, or the offset in the model");
}

}  // namespace
}  // namespace halyard

/// The check finds nothing in a right log: of arms with and without effects, of poor sensors, and of real machines.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "model/arm_log.h"
#include "tests/diagnosis/log_check/checked_logs.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

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
  expect_one(read_log_of(model, run, {}, false), "joint_position_1", Severity::suspicious, {"if its zero is wrong"},
             model);
}

}  // namespace
}  // namespace halyard

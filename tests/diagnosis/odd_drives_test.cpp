/// Logs of motors whose torque has an unknown scale, and of joints that no motor of the log moves.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/diagnosis/odd_logs.h"
#include "tests/support/message_of.h"

namespace halyard {
namespace {

// --------------------------------------------------------------------------------------- torque scales

TEST(TorqueOfUnknownScale, IsRefitted) {
  ArmModel model = first_joints(1);
  model.joints[0].tolerances.torque_scale = 1;
  for (const double amperes : {1000.0, 1e-3}) {  // per N m
    Logs logs = clean_logs();
    for (Log* log : {&logs.train, &logs.holdout})
      for (double& torque : log->motor_torque[0]) torque *= amperes;
    const Diagnosis d = diagnosis_of(model, logs);
    expect_clean(d);
    ASSERT_GE(d.refitted.size(), 1u);
    const Estimated& scale = d.refitted.front();
    EXPECT_EQ(scale.name, "joint 1 motor torque scale");
    EXPECT_EQ(scale.nominal, 1);
    // What moves the arm is told by masses that are known to 5 %.
    EXPECT_NEAR(scale.value * amperes, 1, 0.05);
    EXPECT_EQ(d.revised.nominal.joint[0].torque_scale, scale.value);
  }
}

TEST(TorqueOfUnknownScale, AgainstTheMotionOrOfAnotherMotorIsAnError) {
  ArmModel model = first_joints(1);
  model.joints[0].tolerances.torque_scale = 1;
  Logs logs = clean_logs();
  logs.train.source = "rig.csv";
  for (double& torque : logs.train.motor_torque[0]) torque = -torque;
  const std::string opposed = message_of([&] { diagnosis_of(model, logs); });
  EXPECT_TRUE(
      opposed.starts_with("rig.csv: motor_torque_1: the recorded torque opposes the torque that the motor's "
                          "motion requires"))
      << opposed;
  EXPECT_NE(opposed.find("--column motor_torque_1=motor_torque_1,sign=-1"), std::string::npos) << opposed;
  for (std::size_t i = 0; i < logs.train.size(); ++i)
    logs.train.motor_torque[0][i] = std::sin(37.0 * logs.train.time[i]);
  EXPECT_NE(message_of([&] { diagnosis_of(model, logs); }).find("does not go with the motor's motion (correlation "),
            std::string::npos);
}

// ---------------------------------------------------------------------------- joints without their motor

/// The two-joint arm with an elbow in need of a diagnosis and a shoulder whose drive is nobody's business.
ArmModel elbow_alone() {
  ArmModel model = first_joints(2);
  model.nominal.joint[0].drive = Drive::none;
  return model;
}

TEST(JointDrivenBySomebodyElse, FollowsItsSensor) {
  constexpr double kHalfGap = 3e-4;
  ArmModel truth = first_joints(2);
  truth.effects.push_back(placed("backlash", truth, 1, {kHalfGap}));
  Logs logs = logs_of(truth);
  for (Log* log : {&logs.train, &logs.holdout}) log->motor_position[0].clear(), log->motor_torque[0].clear();
  const Diagnosis d = diagnosis_of(elbow_alone(), logs);
  expect_named(d, "backlash", 1, kHalfGap, 0.1);
  EXPECT_TRUE(std::isnan(d.after.joint_rms[0])) << "given, not predicted";
  EXPECT_LT(d.after.joint_rms[1], 0.2 * d.before.joint_rms[1]);
}

TEST(JointHeldFixed, StandsAtHome) {
  ArmModel truth = first_joints(2);
  truth.nominal.joint[0].joint_coulomb = 500;  // clamped: creeps by less than its sensor's step
  const auto logs = [&](int variant) {
    Scenario s = motion(truth, kLogDuration, variant);
    s.trajectory[0].sines.clear();
    Log log = simulate(s).measured;
    log.motor_position[0].clear(), log.motor_torque[0].clear(), log.joint_position[0].clear();
    return log;
  };
  expect_clean(diagnosis_of(elbow_alone(), {logs(0), logs(1)}));
}

}  // namespace
}  // namespace halyard

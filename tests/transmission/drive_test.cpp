#include "transmission/drive.h"
#include "tests/support/limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/random_arm.h"
#include "transmission/jacobian.h"

namespace halyard {
namespace {

/// Three rigid drives, each coupled with the joints inboard of it.
ArmParameters<double> rigid_arm() {
  ArmParameters<double> arm = random_arm(7, CableLaw::paper);
  for (int k = 0; k < arm.n; ++k) {
    arm.joint[k].drive = Drive::rigid;
    for (int j = k + 1; j < arm.n; ++j) arm.joint[k].coupling[j] = 0;
  }
  return arm;
}

constexpr double kPosition[] = {0.3, -0.7, 0.2}, kRate[] = {1.1, -0.4, 0.9};

TEST(RigidDrive, MotorFollowsJointsAndJointsFollowMotor) {
  const ArmParameters<double> arm = rigid_arm();
  double back[3];
  for (int k = 0; k < arm.n; ++k) {
    back[k] = rigid_joint(arm, k, rigid_motor(arm, k, kPosition), back);
    // Some 10 roundings of numbers below 1, times the motor's turns per joint and back.
    EXPECT_NEAR(back[k], kPosition[k], 20 * kEps);
  }
}

TEST(RigidDrive, MotorAndJointPowerAreEqual) {
  const ArmParameters<double> arm = rigid_arm();
  const double torque[] = {0.8, -0.3, 0.5}, pull[] = {0, 0, 0};
  JointSignals<double> s[kMaxJoints];
  set_motion(arm, kPosition, kRate, s);
  double force[kMaxJoints] = {}, unused[kMaxJoints];
  drive_forces(arm, torque, pull, force, unused);
  double motor_power = 0, joint_power = 0, size = 0;
  for (int k = 0; k < arm.n; ++k) {
    motor_power += torque[k] * s[k].motor_rate;
    joint_power += force[k] * kRate[k];
    size += std::abs(torque[k] * s[k].motor_rate) + std::abs(force[k] * kRate[k]);
  }
  EXPECT_GT(std::abs(motor_power), 0.1 * size) << "nothing cancels by chance";
  EXPECT_NEAR(motor_power, joint_power, 10 * kEps * size);
}

TEST(RigidDrive, JointsCarryTheEnergyOfTheRotors) {
  const ArmParameters<double> arm = rigid_arm();
  double M[kMaxJoints][kMaxJoints] = {};
  add_rotor_mass(arm, M);
  double by_joints = 0, by_rotors = 0;
  for (int k = 0; k < arm.n; ++k) {
    for (int j = 0; j < arm.n; ++j) by_joints += 0.5 * M[k][j] * kRate[k] * kRate[j];
    by_rotors += 0.5 * arm.joint[k].rotor_inertia * std::pow(rigid_motor(arm, k, kRate), 2);
  }
  // Nine terms of mixed sign, a few times as large as their sum.
  EXPECT_NEAR(by_joints, by_rotors, 200 * kEps * by_rotors);
}

TEST(CableDrive, RotorTurnsUnderWhatThePullLeavesOfTheTorque) {
  const ArmParameters<double> arm = random_arm(3, CableLaw::paper);
  const double torque[] = {0.8, -0.3, 0.5}, pull[] = {4, 5, -6};
  double force[kMaxJoints] = {}, acceleration[kMaxJoints];
  drive_forces(arm, torque, pull, force, acceleration);
  for (int k = 0; k < arm.n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    EXPECT_DOUBLE_EQ(acceleration[k] * j.rotor_inertia, torque[k] - j.capstan_radius / j.gear_ratio * pull[k]);
    EXPECT_EQ(force[k], 0) << "its cable pulls the joint, not its torque";
  }
}

TEST(Coupling, OneCablesReactionIsItsShareOfAll) {
  const ArmParameters<double> arm = random_arm(5, CableLaw::paper);
  const double g[] = {0, 3.7, 0};
  double all[kMaxJoints], one[kMaxJoints] = {};
  joint_reaction(arm, g, all);
  add_cable_reaction(arm, 1, g[1], one);
  for (int k = 0; k < arm.n; ++k) EXPECT_DOUBLE_EQ(one[k], all[k]);
}

TEST(Jacobian, IsThatOfAClosedFormOverSeveralPasses) {
  // y_r = Π over entries r, r + 1, r + 2 of sin x: more entries than one pass has directions.
  constexpr int kIn = 2 * kDualWidth + 2, kOut = kIn - 2;
  int passes = 0;
  const auto f = [&](const Dual* x, Dual* y) {
    ++passes;
    for (int r = 0; r < kOut; ++r) y[r] = sin(x[r]) * sin(x[r + 1]) * sin(x[r + 2]);
  };
  Eigen::VectorXd x(kIn), y(kOut);
  for (int i = 0; i < kIn; ++i) x(i) = 0.3 + 0.2 * i;
  Eigen::MatrixXd J(kOut, kIn);
  jacobian(f, x, y, J);
  EXPECT_EQ(passes, 3);
  for (int r = 0; r < kOut; ++r) {
    const double product = std::sin(x(r)) * std::sin(x(r + 1)) * std::sin(x(r + 2));
    EXPECT_NEAR(y(r), product, 4 * kEps);
    for (int c = 0; c < kIn; ++c) {
      const double expected = c < r || c > r + 2 ? 0 : product * std::cos(x(c)) / std::sin(x(c));
      EXPECT_NEAR(J(r, c), expected, 10 * kEps) << r << " " << c;
    }
  }
}

TEST(CableDrive, TheJointsDoNotCarryItsRotor) {
  const ArmParameters<double> arm = random_arm(3, CableLaw::paper);
  double M[kMaxJoints][kMaxJoints] = {};
  add_rotor_mass(arm, M);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(M[r][c], 0) << r << c;
}

TEST(JointWithoutDrive, HasNoMotorThatTurns) {
  ArmParameters<double> arm = random_arm(3, CableLaw::paper);
  arm.joint[1].drive = Drive::none;
  JointSignals<double> s[kMaxJoints];
  for (JointSignals<double>& of_joint : s) of_joint.motor_angle = of_joint.motor_rate = 5;
  set_motion(arm, kPosition, kRate, s);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(s[k].joint_position, kPosition[k]) << k;
    EXPECT_EQ(s[k].joint_rate, kRate[k]) << k;
    // Motors of cables move on their own.
    EXPECT_EQ(s[k].motor_angle, k == 1 ? 0 : 5) << k;
    EXPECT_EQ(s[k].motor_rate, k == 1 ? 0 : 5) << k;
  }
}

}  // namespace
}  // namespace halyard

/// The loaded poses at which the equations are stiffest.

#include "estimators/process/standstill.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimators/process/process_model.h"
#include "tests/support/arm_runs.h"
#include "tests/support/pendulum.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

TEST(Standstill, EachCableCarriesItsMotorsLimitInEitherDirection) {
  ArmModel model = raven2();
  for (int k = 0; k < 3; ++k) model.joints[k].controller.torque_limit = 0.1 * (k + 1);
  const ProcessModel process(model);
  const ArmParameters<double>& arm = process.arm();
  const std::vector<StandstillPose> poses = standstill_poses(process.transmission(), model);
  ASSERT_EQ(poses.size(), 3 * range_poses(model).size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double way[] = {0, 1, -1};  // of the three poses at the same joint positions
    double path[3];
    cable_path(arm, poses[i].joint_position.data(), path);
    for (int k = 0; k < 3; ++k) {
      const JointParameters<double>& j = arm.joint[k];
      const double stretch = j.motor_travel() * poses[i].motor_angle(k) - path[k];
      const double limit = model.joints[k].controller.torque_limit / j.motor_travel();
      // The stretch is bisected to 1e-3 of itself; the force is in proportion to it.
      EXPECT_NEAR(cable_force(j, stretch, 0.0), way[i % 3] * limit, 2e-3 * limit)
          << "pose " << i << ", joint " << k + 1;
    }
  }
}

TEST(Standstill, WithoutALimitEachCableCarriesItsTensionAndGravity) {
  ArmModel model = raven2();
  for (int k = 0; k < 3; ++k) {
    model.joints[k].controller.torque_limit = 0;
    model.nominal.joint[k].tension = 20 * (k + 1);
  }
  const ProcessModel process(model);
  const ArmParameters<double>& arm = process.arm();
  const std::vector<StandstillPose> poses = standstill_poses(process.transmission(), model);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double way[] = {0, 1, -1};
    double path[3];
    cable_path(arm, poses[i].joint_position.data(), path);
    const Eigen::VectorXd gravity = gravity_force(arm, poses[i].joint_position);
    for (int k = 0; k < 3; ++k) {
      const JointParameters<double>& j = arm.joint[k];
      const double force = j.tension + std::abs(gravity(k)) / j.pulley_radius;
      const double stretch = j.motor_travel() * poses[i].motor_angle(k) - path[k];
      EXPECT_NEAR(cable_force(j, stretch, 0.0), way[i % 3] * force, 2e-3 * force)
          << "pose " << i << ", joint " << k + 1;
    }
  }
}

TEST(RangePoses, AreHomeTheEndsOfEachJointAndBothCorners) {
  ArmModel model = raven2();
  model.joints[1].upper = model.joints[1].lower;  // no range given
  const Eigen::VectorXd home = model.home();
  const std::vector<Eigen::VectorXd> poses = range_poses(model);
  ASSERT_EQ(poses.size(), 1u + 2 * 2 + 2);
  EXPECT_EQ(poses[0], home);
  std::size_t next = 1;
  Eigen::VectorXd lower = home, upper = home;
  for (const int k : {0, 2}) {
    for (const double end : {model.joints[k].lower, model.joints[k].upper}) {
      Eigen::VectorXd q = home;
      q(k) = end;
      EXPECT_EQ(poses[next++], q) << k;
    }
    lower(k) = model.joints[k].lower;
    upper(k) = model.joints[k].upper;
  }
  EXPECT_EQ(poses[next], lower);
  EXPECT_EQ(poses[next + 1], upper);
}

TEST(LargestGravityForce, OfAPendulumIsThatOfItsSteepestPose) {
  ArmModel model = pendulum();
  const JointParameters<double>& j = model.nominal.joint[0];
  const double weight =
      j.mass * Eigen::Vector3d(model.nominal.gravity[0], model.nominal.gravity[1], model.nominal.gravity[2]).norm();
  model.joints[0].home = 0.3;
  model.joints[0].lower = -0.2;
  model.joints[0].upper = 1.1;
  EXPECT_NEAR(largest_gravity_force(model.nominal, model)(0), weight * j.com[0] * std::sin(1.1), 1e-12 * weight);
  model.joints[0].lower = -1.4;
  EXPECT_NEAR(largest_gravity_force(model.nominal, model)(0), weight * j.com[0] * std::sin(1.4), 1e-12 * weight);
}

}  // namespace
}  // namespace halyard

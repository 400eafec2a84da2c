/// The loaded poses at which the equations are stiffest.

#include "estimators/process/standstill.h"

#include <gtest/gtest.h>

#include "estimators/process/process_model.h"
#include "tests/support/arm_runs.h"
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

}  // namespace
}  // namespace halyard

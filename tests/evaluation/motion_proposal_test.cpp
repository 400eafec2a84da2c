#include "evaluation/studies/motion_proposal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "plant/trajectory.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

TEST(RandomMotion, StaysWithinTheRangesOfTheJoints) {
  const Scenario given = motion(first_joints(2), 2);
  std::set<JointTrajectory::Kind> kinds;
  for (int i = 0; i < 12; ++i) {
    const Scenario drawn = random_motion(given, i);
    for (int k = 0; k < 2; ++k) {
      kinds.insert(drawn.trajectory[k].kind);
      for (double t = 0; t < drawn.duration_s; t += 0.01) {
        const double q = desired_position(drawn.trajectory[k], drawn.fade_in_s, t);
        // Centres, amplitudes and points are rounded to four digits.
        EXPECT_GE(q, given.robot.joints[k].lower - 1e-3) << i << ' ' << k;
        EXPECT_LE(q, given.robot.joints[k].upper + 1e-3) << i << ' ' << k;
      }
    }
  }
  EXPECT_EQ(kinds.size(), 2u) << "sines alone, or moves alone";
}

TEST(RandomMotion, OfAJointWithoutARangeStaysWithinTheGivenMotion) {
  Scenario given = motion(first_joints(1), 2);
  given.robot.joints[0].lower = given.robot.joints[0].upper = 0;
  double least = given.robot.joints[0].home, most = least;
  for (double t = 0; t <= given.duration_s; t += 0.01) {
    const double q = desired_position(given.trajectory[0], given.fade_in_s, t);
    least = std::min(least, q), most = std::max(most, q);
  }
  for (int i = 0; i < 12; ++i) {
    const Scenario drawn = random_motion(given, i);
    for (double t = 0; t < drawn.duration_s; t += 0.01) {
      const double q = desired_position(drawn.trajectory[0], drawn.fade_in_s, t);
      EXPECT_GE(q, least - 1e-3) << i;
      EXPECT_LE(q, most + 1e-3) << i;
    }
  }
}

TEST(RandomMotion, OfAJointWithoutAControllerIsTheGivenOne) {
  Scenario given = motion(first_joints(2), 2);
  const JointTrajectory drawn = random_motion(given, 3).trajectory[0];
  given.robot.joints[1].controller = {};
  given.trajectory[1] = JointTrajectory();
  given.trajectory[1].center = 1.5;
  const Scenario with_one_held = random_motion(given, 3);
  EXPECT_EQ(with_one_held.trajectory[1].kind, JointTrajectory::Kind::hold);
  EXPECT_EQ(with_one_held.trajectory[1].center, 1.5);
  EXPECT_EQ(with_one_held.trajectory[0].kind, drawn.kind) << "the other joints move as before";
  EXPECT_EQ(with_one_held.trajectory[0].center, drawn.center);
}

TEST(PlannedLog, HasJointPositionsOnlyIfThereIsASensor) {
  const ArmModel model = first_joints(1);
  const Scenario scenario = planned_scenario(motion(model, 0.2), model);
  EXPECT_TRUE(planned_log(scenario, true).has_joint_position(0));
  const Log without = planned_log(scenario, false);
  EXPECT_FALSE(without.has_joint_position(0));
  EXPECT_EQ(without.motor_position, planned_log(scenario, true).motor_position);
}

}  // namespace
}  // namespace halyard

#include "evaluation/studies/motion_proposal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "plant/trajectory.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

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

TEST(Proposal, IsReadFromItsFileAsItWasDrawn) {
  const fs::path folder = fs::path(testing::TempDir()) / "motion_proposal";
  fs::create_directories(folder);
  fs::copy_file(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml", folder / "arm.xml",
                fs::copy_options::overwrite_existing);
  Scenario given = motion(first_joints(3), 3);
  given.noise.joint_reading = {1e-5, 0, 2e-5};
  given.seed = 7;
  given.homed = true;
  given.robot.joints[1].controller = {};
  given.trajectory[1] = JointTrajectory();
  given.trajectory[1].center = 1.5;
  for (int i = 0; i < 4; ++i) {
    const Scenario drawn = random_motion(given, i);
    std::ofstream(folder / "proposal.xml") << proposal_xml(drawn, "arm.xml");
    const Scenario read = read_scenario(folder / "proposal.xml");
    EXPECT_EQ(read.name, drawn.name);
    EXPECT_EQ(read.duration_s, drawn.duration_s);
    EXPECT_EQ(read.seed, 7u);
    EXPECT_TRUE(read.homed);
    EXPECT_EQ(read.fade_in_s, drawn.fade_in_s);
    EXPECT_EQ(read.control_period_s, drawn.control_period_s);
    EXPECT_EQ(read.noise.joint_reading, drawn.noise.joint_reading);
    for (int k = 0; k < 3; ++k)
      for (double t = 0; t < 3; t += 0.1)
        EXPECT_EQ(desired_position(read.trajectory[k], read.fade_in_s, t),
                  desired_position(drawn.trajectory[k], drawn.fade_in_s, t))
            << i << ' ' << k << ' ' << t;
  }
  fs::remove_all(folder);
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

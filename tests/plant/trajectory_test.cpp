#include "plant/trajectory.h"

#include <gtest/gtest.h>

#include "tests/support/message_of.h"

namespace halyard {
namespace {

using Kind = JointTrajectory::Kind;

std::string refusal_of(const JointTrajectory& t) {
  return message_of([&] { check_trajectory(t); });
}

TEST(TrajectoryCheck, RefusesMovesThatTakeNoTime) {
  JointTrajectory t;
  t.kind = Kind::point_to_point;
  EXPECT_EQ(refusal_of(t), "no points: give at least one position to stand at");
  t.points = {1, 2};
  t.move_s = 0.5;
  t.dwell_s = 0;
  EXPECT_EQ(refusal_of(t), "no InputError");
  t.dwell_s = -0.1;
  EXPECT_EQ(refusal_of(t), "moves must take more than 0 s and dwells not less than 0 s");
  t.dwell_s = 0;
  t.move_s = 0;
  EXPECT_EQ(refusal_of(t), "moves must take more than 0 s and dwells not less than 0 s");
}

TEST(TrajectoryCheck, RefusesSamplesThatAreNoFunctionOfTime) {
  JointTrajectory t;
  t.kind = Kind::samples;
  EXPECT_EQ(refusal_of(t), "no samples, or not one position for each time");
  t.sample_time = {0, 1, 2};
  t.sample_position = {0, 1};
  EXPECT_EQ(refusal_of(t), "no samples, or not one position for each time");
  t.sample_position.push_back(2);
  EXPECT_EQ(refusal_of(t), "no InputError");
  t.sample_time[2] = 1;
  EXPECT_EQ(refusal_of(t), "times of samples do not increase");
}

TEST(SampledTrajectory, RunsStraightBetweenItsSamplesAndStaysBeforeAndAfter) {
  JointTrajectory t;
  t.kind = Kind::samples;
  t.sample_time = {1, 2, 4};
  t.sample_position = {10, 20, 0};
  EXPECT_EQ(desired_position(t, 0, 0.5), 10);
  EXPECT_EQ(desired_position(t, 0, 1.25), 12.5);
  EXPECT_EQ(desired_position(t, 0, 2), 20);
  EXPECT_EQ(desired_position(t, 0, 3.5), 5);
  EXPECT_EQ(desired_position(t, 0, 9), 0);
}

}  // namespace
}  // namespace halyard

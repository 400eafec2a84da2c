#include "plant/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

TEST(Trajectory, OfSinesStartsAtItsCenterAtRest) {
  JointTrajectory t;
  t.kind = Kind::sines;
  t.center = 0.5;
  t.sines = {{0.2, 0.4, 1.0}, {0.1, 0.9, 0}};
  EXPECT_EQ(desired_position(t, 2, 0), 0.5);
  // f(s) grows as 10 s³: within 1 ms by less than 2e-9 of the amplitudes.
  EXPECT_NEAR(desired_position(t, 2, 1e-3), 0.5, 2e-9);
  const double after = 7.3, w = 2 * std::numbers::pi * after;
  EXPECT_DOUBLE_EQ(desired_position(t, 2, after), 0.5 + 0.2 * std::sin(0.4 * w + 1.0) + 0.1 * std::sin(0.9 * w));
}

TEST(Trajectory, BetweenPointsStaysAmongThemHoweverShortAMoveIs) {
  JointTrajectory t;
  t.kind = JointTrajectory::Kind::point_to_point;
  t.points = {1, 2, 3};
  t.move_s = 1e-300;
  const double q = desired_position(t, 0, 1);
  EXPECT_GE(q, 1);
  EXPECT_LE(q, 3);
}

TEST(Trajectory, BetweenPointsMovesWithMinimumJerkAndDwells) {
  JointTrajectory t;
  t.kind = Kind::point_to_point;
  t.points = {1, 2, 4};
  t.move_s = 1;
  t.dwell_s = 0.5;
  EXPECT_EQ(desired_position(t, 0, 0), 1);
  EXPECT_DOUBLE_EQ(desired_position(t, 0, 0.5), 1.5);  // half way at half time
  EXPECT_EQ(desired_position(t, 0, 1.2), 2);
  EXPECT_DOUBLE_EQ(desired_position(t, 0, 2.0), 3);
  EXPECT_DOUBLE_EQ(desired_position(t, 0, 3.5), 2.5);  // from the last point to the first
  EXPECT_EQ(desired_position(t, 0, 4.5), 1);
  // Peak speed of a minimum-jerk move is 15/8 of the mean.
  EXPECT_NEAR((desired_position(t, 0, 0.5 + 1e-4) - desired_position(t, 0, 0.5 - 1e-4)) / 2e-4, 15.0 / 8, 1e-6);
}

}  // namespace
}  // namespace halyard

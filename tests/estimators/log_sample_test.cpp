/// Rows of a log as an estimator's input.

#include "estimators/log_sample.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/limits.h"

namespace halyard {
namespace {

TEST(LogSample, ARowWithoutAFrameForgetsTheFrameBefore) {
  Log log(1);
  log.time = {0, 1e-3};
  log.motor_torque[0] = {0.5, kNan};
  log.motor_position[0] = {2, 3};
  log.marker = {{0.1, kNan}, {0.2, kNan}, {0.3, kNan}};
  Sample sample;
  read_row(log, 0, sample);
  ASSERT_EQ(sample.marker.size(), 3);
  EXPECT_EQ(sample.marker(2), 0.3);
  read_row(log, 1, sample);
  EXPECT_EQ(sample.time_s, 1e-3);
  EXPECT_EQ(sample.marker.size(), 0);
  EXPECT_TRUE(std::isnan(sample.motor_torque(0)));
  EXPECT_EQ(sample.motor_position(0), 3);
}

TEST(LogSample, AJointWithoutAMotorsColumnsHasNoTorqueAndStandsAtZero) {
  Log log(2);
  log.time = {0};
  log.motor_torque[0] = {0.5};
  log.motor_position[0] = {2};
  const Sample sample = sample_of(log, 0);
  EXPECT_TRUE(std::isnan(sample.motor_torque(1)));
  EXPECT_EQ(sample.motor_position(1), 0);
  EXPECT_EQ(sample.marker.size(), 0);
}

}  // namespace
}  // namespace halyard

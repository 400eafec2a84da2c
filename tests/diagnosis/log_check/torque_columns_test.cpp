/// Torques that stay the same while their motor moves, and those that may.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/diagnosis/log_check/checked_logs.h"

namespace halyard {
namespace {

Log with_frozen_torque(int k, int from, int to) {
  Log log = right_log();
  for (int i = from; i < to; ++i) log.motor_torque[k][i] = log.motor_torque[k][from];
  return log;
}

TEST(FrozenTorque, IsSuspectedWhileItsMotorMoves) {
  for (int k = 0; k < 3; ++k) {
    const std::string column = numbered("motor_torque_", k);
    const std::vector<double>& torque = right_log().motor_torque[k];
    // Motor 3 is often at its limit, where a torque may stay.
    const auto from = std::find_if(torque.begin() + 2000, torque.end(), [](double t) { return std::abs(t) < 0.05; });
    const auto row = static_cast<int>(from - torque.begin());
    expect_one(with_frozen_torque(k, row, row + 1501), column, Severity::suspicious,
               {"stays the same for 1.5 s while its motor moves, longest from ",
                "leave these cells empty, or read the log without this torque with --column " + column + "=:"});
    expect_one(with_frozen_torque(k, 0, 6001), column, Severity::suspicious,
               {"is exactly ", "all the time", "read the log without this torque with --column " + column + "=:"});
  }
}

TEST(FrozenTorque, AddsUpSeveralStretchesAndTellsTheLongest) {
  Log log = with_frozen_torque(1, 1000, 1501);
  for (int i = 4000; i < 5001; ++i) log.motor_torque[1][i] = log.motor_torque[1][4000];
  expect_one(log, "motor_torque_2", Severity::suspicious,
             {"stays the same for 1.5 s while its motor moves, longest from 4 to 5 s"});
}

TEST(FrozenTorque, IsNoneWhileTheMotorHardlyMoves) {
  Log log = right_log();
  for (auto* signal : {&log.motor_torque, &log.motor_position, &log.joint_position})
    for (auto& column : *signal) std::fill(column.begin() + 2000, column.begin() + 3500, column[2000]);
  EXPECT_EQ(lines_of(check_log(log, raven())).find("stays the same"), std::string::npos);
}

TEST(FrozenTorque, IsNoneForAQuarterOfASecondOrIfTheDriveIsOff) {
  expect_right(with_frozen_torque(1, 2000, 2250), raven(), "0.249 s");
  Log log = right_log();
  std::fill(log.motor_torque[1].begin() + 2000, log.motor_torque[1].begin() + 3500, 0);
  EXPECT_EQ(lines_of(check_log(log, raven())).find("stays the same"), std::string::npos);
}

TEST(FrozenTorque, IsNoneAtTheLimitOfItsDrive) {
  ArmModel model = raven();
  const double limit = 0.4 * *std::ranges::max_element(right_log().motor_torque[1]);
  model.joints[1].controller.torque_limit = limit;
  const Log log = changed(&Log::motor_torque, 1, [=](double t) { return std::clamp(t, -1.01 * limit, limit); });
  EXPECT_EQ(lines_of(check_log(log, model)).find("stays the same"), std::string::npos);
}

TEST(FrozenTorque, IsNoneIfTheCommandUsuallyStaysSoLong) {
  Log log = right_log();
  for (std::size_t i = 0; i < log.size(); ++i) log.motor_torque[1][i] = log.motor_torque[1][i - i % 300];
  EXPECT_EQ(lines_of(check_log(log, raven())).find("stays the same"), std::string::npos);
}

}  // namespace
}  // namespace halyard

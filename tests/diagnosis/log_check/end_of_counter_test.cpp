/// Positions that stop at the end of a counter, several wrong torques, and times at the ends of what a log may have.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>

#include "model/arm_log.h"
#include "tests/diagnosis/log_check/checked_logs.h"

namespace halyard {
namespace {

std::string in_six_digits(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

TEST(LogCheck, SuspectsAMotorThatStopsAtTheEndOfItsCounter) {
  // A joint's sensor would tell that it stands still.
  const auto [low, high] = std::ranges::minmax(right_log().motor_position[0]);
  for (const double share : {0.2, 0.8}) {
    const double end = low + share * (high - low);
    const Log log = without_joint_sensors(
        changed(&Log::motor_position, 0, [&](double q) { return share < 0.5 ? std::max(q, end) : std::min(q, end); }));
    const std::string told = lines_of(check_log(log, raven()));
    EXPECT_NE(told.find("suspicious: rig.csv: motor_position_1: stops abruptly at its extreme value " +
                        in_six_digits(end) + " "),
              std::string::npos)
        << told;
  }
}

TEST(LogCheck, SuspectsAMotorWhoseCounterEndsWhereItIsSlow) {
  const std::filesystem::path folder = std::filesystem::path(HALYARD_SOURCE_DIR) / "examples/raven2";
  const ArmModel model = read_model(folder / "raven2.xml");
  const Log right = without_joint_sensors(read_log_of(model, folder / "undeclared_effect.csv"));
  // Of the three stops at 108 to 140 rad one alone is as fast as half of the motor's usual speed.
  for (const double end : {80, 108, 118, 140, 150}) {
    Log log = right;
    for (double& q : log.motor_position[0]) q = std::min(q, end);
    const std::string told = lines_of(check_log(log, model));
    EXPECT_NE(told.find("motor_position_1: stops abruptly at its extreme value " + in_six_digits(end) + " "),
              std::string::npos)
        << end << told;
  }
  expect_right(right, model);
}

/// A motor that goes to and fro by 40 rad, and comes to rest at both ends within `slowing` s for `rest` s.
Log with_rests(double slowing, double rest) {
  Log log(1);
  const double speed = 50, cruise = 40 / speed - slowing, phase = cruise + 2 * slowing + rest;
  for (int i = 0; i < 8000; ++i) {
    const double t = 1e-3 * i, in = std::fmod(t, phase);
    double q = 0;  // of 40
    if (in < slowing) q = 0.5 * speed / slowing * in * in;
    else if (in < slowing + cruise) q = 0.5 * speed * slowing + speed * (in - slowing);
    else if (in < cruise + 2 * slowing) q = 40 - 0.5 * speed / slowing * std::pow(cruise + 2 * slowing - in, 2);
    else q = 40;
    const bool is_back = static_cast<int>(t / phase) % 2 == 1;
    constexpr double kCount = 2 * std::numbers::pi / 4000;
    log.time.push_back(t);
    log.motor_position[0].push_back(kCount * std::floor((100 + (is_back ? 40 - q : q)) / kCount));
  }
  return log;
}

TEST(LogCheck, SuspectsNoMotorThatSlowsDownBeforeItRests) {
  const auto told = [](double slowing) {
    return lines_of(check_log(with_rests(slowing, 0.3), first_joints(1))).find("stops abruptly") != std::string::npos;
  };
  // Within 20 samples it is slower beside its rest; within one no controller stops a rotor.
  EXPECT_FALSE(told(0.02));
  EXPECT_FALSE(told(0.1));
  EXPECT_TRUE(told(0.001));
}

TEST(LogCheck, SuspectsNoMotorThatCreepsToAShortRest) {
  // 40 rad to and fro within 1 s. Beyond it creeps by 0.6 rad, and rests for 0.1 s. With a counter that ends there it
  // would have turned round within 0.1 s after 0.08 rad, and usually it does so after 0.5 rad.
  constexpr double kCount = 2 * std::numbers::pi / 4000, kCreeping = 0.2, kRest = 0.1,
                   kPhase = 1 + 2 * kCreeping + kRest;
  Log log(1);
  for (int i = 0; i < 9000; ++i) {
    const double t = 1e-3 * i, in = std::fmod(t, kPhase) - 1;
    const double creeping = std::min({in, kCreeping, 2 * kCreeping + kRest - in});
    const double q = in < 0 ? 20 * std::cos(2 * std::numbers::pi * in) : 20 + 3 * creeping;
    log.time.push_back(t);
    log.motor_position[0].push_back(kCount * std::floor((100 + q) / kCount));
  }
  EXPECT_EQ(lines_of(check_log(log, first_joints(1))).find("stops abruptly"), std::string::npos);
}

TEST(LogCheck, SuspectsNoMotorThatIsHeldAndStepsBetweenAFewCounts) {
  constexpr double kCount = 1.5e-3;
  Log log = without_joint_sensors(right_log());
  for (std::size_t i = 0; i < log.size(); ++i)
    log.motor_position[0][i] =
        kCount * (i % 500 < 60 ? 2.0 : static_cast<double>(i / 2 % 2));  // rests at its last count
  EXPECT_EQ(lines_of(check_log(log, raven())).find("stops abruptly"), std::string::npos);
}

TEST(LogCheck, SuspectsNoJointThatIsHeldAndDrifts) {
  Log log = right_log();
  const double count = raven().nominal.joint[2].joint_encoder_resolution;
  // It drifts by half a millimetre, and several times stands at its lowest reading.
  for (std::size_t i = 0; i < log.size(); ++i) {
    const double t = log.time[i], way = std::max(0.0, std::sin(8 * t)) * 0.5e-3;
    log.joint_position[2][i] = 0.4 + count * std::floor(way / count);
    log.motor_position[2][i] = log.motor_position[2][0];
  }
  EXPECT_EQ(lines_of(check_log(log, raven())).find("stops abruptly"), std::string::npos);
}

TEST(LogCheck, CountsTheTorquesOfAnImpossibleSizeBesideTheFirst) {
  for (const std::size_t spikes : {1, 2, 3}) {
    Log log = right_log();
    for (std::size_t i = 0; i < spikes; ++i) log.motor_torque[1][700 + 100 * i] = -1e6;
    const std::string told = lines_of(check_log(log, raven())), more = " (and " + std::to_string(spikes - 1) + " more)";
    EXPECT_EQ(told.find(more) != told.npos, spikes > 1) << told;
    EXPECT_EQ(told.find("more)") != told.npos, spikes > 1) << told;
  }
}

/// A log whose samples follow each other after `step` s.
Log with_step(double step) {
  Log log = right_log();
  for (std::size_t i = 0; i < log.size(); ++i) log.time[i] = step * static_cast<double>(i);
  return log;
}

TEST(LogCheck, TakesTenSamplesASecondForPlausibleAndFewerNot) {
  EXPECT_EQ(lines_of(check_log(with_step(0.1), raven())).find("expected at least 10"), std::string::npos);
  const std::string slow = lines_of(check_log(with_step(0.101), raven())),
                    fast = lines_of(check_log(with_step(1.9e-5), raven()));
  EXPECT_NE(slow.find("gross: rig.csv: time: a sample follows another after 0.101 s; expected at least 10 and at most "
                      "50000 samples a second"),
            std::string::npos)
      << slow;
  EXPECT_NE(fast.find("gross: rig.csv: time: a sample follows another after 1.9e-05 s"), std::string::npos) << fast;
  EXPECT_NE(fast.find("it looks like a time in minutes"), std::string::npos) << fast;
  EXPECT_EQ(fast.find(" or "), std::string::npos) << fast;
}

}  // namespace
}  // namespace halyard

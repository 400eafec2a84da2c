/// The options that messages name: read with them, the file has nothing suspicious left.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <ostream>
#include <regex>

#include "model/arm_log.h"
#include "tests/diagnosis/log_check/checked_logs.h"
#include "tests/support/small_arm.h"

namespace halyard {
namespace {

constexpr auto kMotor = &Log::motor_position, kJoint = &Log::joint_position, kTorque = &Log::motor_torque;

/// A kind of error, and the column that is blamed for it.
struct Spoilt {
  const char* name;
  const char* column;
  std::function<void(Log&)> spoil;
};
void PrintTo(const Spoilt& spoilt, std::ostream* out) { *out << spoilt.name; }

/// The options --column of the first remedy that a finding names; the text goes on with alternatives.
std::vector<std::string> options_of(const LogFinding& finding) {
  static const std::regex kOptions("--column [^ ]*[^ ,;:.](?: --column [^ ]*[^ ,;:.])*");
  std::smatch all;
  if (!std::regex_search(finding.remedy, all, kOptions)) return {};
  std::vector<std::string> entries;
  static const std::regex kOne("--column ([^ ]+)");
  const std::string text = all[0];
  for (std::sregex_iterator i(text.begin(), text.end(), kOne), end; i != end; ++i) entries.push_back((*i)[1]);
  return entries;
}

void write_csv(const Log& log, const std::filesystem::path& path) {
  std::ofstream file(path);
  file.precision(15);
  file << "time";
  for_each_column(log, [&](const std::string& name, const std::vector<double>& values) {
    if (!values.empty()) file << "," << name;
  });
  // Every second row is enough.
  for (std::size_t i = 0; i < log.size(); i += 2) {
    file << "\n" << log.time[i];
    for_each_column(log, [&](const std::string&, const std::vector<double>& values) {
      if (!values.empty()) file << "," << values[i];
    });
  }
  file << "\n";
}

class Remedy : public ::testing::TestWithParam<Spoilt> {};

TEST_P(Remedy, OfTheMessageMendsTheFile) {
  Log log = right_log();
  GetParam().spoil(log);
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) /
                                     ("halyard-" + std::string(GetParam().name) + std::to_string(::getpid()) + ".csv");
  write_csv(log, path);
  const auto findings = [&](const std::vector<std::string>& entries) {
    return check_log(read_log_of(raven(), path, entries, false), raven(), columns_of(raven(), entries));
  };
  const std::vector<LogFinding> found = findings({});
  ASSERT_EQ(found.size(), 1u) << lines_of(found);
  EXPECT_EQ(found[0].column, GetParam().column);
  const std::vector<std::string> options = options_of(found[0]);
  ASSERT_FALSE(options.empty()) << found[0].remedy;
  EXPECT_EQ(lines_of(findings(options)), "") << found[0].remedy;
  std::filesystem::remove(path);
}

auto scale(Signals Log::*signal, int k, double factor) {
  return [=](Log& log) {
    for (double& x : (log.*signal)[k]) x *= factor;
  };
}
auto shift(Signals Log::*signal, int k, double by) {
  return [=](Log& log) {
    for (double& x : (log.*signal)[k]) x += by;
  };
}
/// Column k gets the values of joint p[k].
auto permute(Signals Log::*signal, const std::vector<int>& p) {
  return [=](Log& log) {
    const Signals right = log.*signal;
    for (std::size_t k = 0; k < p.size(); ++k) (log.*signal)[k] = right[p[k]];
  };
}
auto exchange(Signals Log::*a, Signals Log::*b, int k) {
  return [=](Log& log) { std::swap((log.*a)[k], (log.*b)[k]); };
}
auto hold(Signals Log::*signal, int k, int from, int to) {
  return [=](Log& log) { std::fill_n((log.*signal)[k].begin() + from, to - from, (log.*signal)[k][from]); };
}
/// Readings that stop at a share of their range.
auto saturate(Signals Log::*signal, int k, double share) {
  return [=](Log& log) {
    std::vector<double>& x = (log.*signal)[k];
    const auto [low, high] = std::ranges::minmax(x);
    for (double& v : x) v = std::min(v, low + share * (high - low));
  };
}
auto time_in(double seconds) {
  return [=](Log& log) {
    for (double& t : log.time) t /= seconds;
  };
}
/// The same without the sensors of the joints.
auto blind(const std::function<void(Log&)>& spoil) {
  return [=](Log& log) {
    spoil(log);
    log = without_joint_sensors(std::move(log));
  };
}
auto wrap(Signals Log::*signal, int k, double period) {
  return [=](Log& log) {
    const double first = (log.*signal)[k][0];
    for (double& x : (log.*signal)[k]) x -= period * std::floor((x - first) / period + 0.3);
  };
}

std::vector<Spoilt> signs_and_units() {
  const double counts = raven().nominal.joint[1].joint_encoder_resolution;
  return {
      {"ReversedMotor", "motor_position_1", scale(kMotor, 0, -1)},
      {"ReversedJoint", "joint_position_2", scale(kJoint, 1, -1)},
      {"ReversedTorque", "motor_torque_3", scale(kTorque, 2, -1)},
      {"ReversedMotorWithoutSensors", "motor_position_2", blind(scale(kMotor, 1, -1))},
      {"ReversedTorqueWithoutSensors", "motor_torque_2", blind(scale(kTorque, 1, -1))},
      {"JointInDegrees", "joint_position_1", scale(kJoint, 0, 1 / kDegree)},
      {"JointInTurns", "joint_position_1", scale(kJoint, 0, 0.5 / std::numbers::pi)},
      {"JointInMillimetres", "joint_position_3", scale(kJoint, 2, 1e3)},
      {"JointInCounts", "joint_position_2", scale(kJoint, 1, 1 / counts)},
      {"MotorInDegrees", "motor_position_2", scale(kMotor, 1, 1 / kDegree)},
      {"MotorBehindTheGear", "motor_position_3", scale(kMotor, 2, 1 / 12.25)},
      {"MotorInDegreesWithoutSensors", "motor_position_1", blind(scale(kMotor, 0, 1 / kDegree))},
      {"TorqueInMillinewtonmetres", "motor_torque_1", scale(kTorque, 0, 1e3)},
      {"TorqueBehindTheGear", "motor_torque_2", scale(kTorque, 1, 12.25)},
      {"RatioThatMayBeTheArms", "joint_position_1", scale(kJoint, 0, 1.8)},
      {"RatioThatNoUnitExplains", "joint_position_2", scale(kJoint, 1, 5)},
      {"RatioThatNoUnitExplainsTheOtherWay", "joint_position_1", scale(kJoint, 0, 0.05)},
  };
}

std::vector<Spoilt> zeros_and_counters() {
  return {
      {"ZeroOfAJoint", "joint_position_1", shift(kJoint, 0, 2)},
      {"ZeroOfAMotor", "motor_position_2", shift(kMotor, 1, -200)},
      {"ZeroOfAMotorWithoutSensors", "motor_position_2", blind(shift(kMotor, 1, -200))},
      {"ZeroOfAMotorWithoutSensorsTheOtherWay", "motor_position_1", blind(shift(kMotor, 0, 300))},
      {"MotorThatWraps", "motor_position_1", wrap(kMotor, 0, 2 * std::numbers::pi)},
  };
}

std::vector<Spoilt> exchanges() {
  return {
      {"SwappedMotors", "motor_position_1", permute(kMotor, {1, 0, 2})},
      {"SwappedJoints", "joint_position_2", permute(kJoint, {0, 2, 1})},
      {"SwappedTorques", "motor_torque_1", permute(kTorque, {2, 1, 0})},
      {"SwappedMotorsWithoutSensors", "motor_position_1", blind(permute(kMotor, {2, 1, 0}))},
      {"SwappedTorquesWithoutSensors", "motor_torque_1", blind(permute(kTorque, {1, 0, 2}))},
      {"CircleOfMotors", "motor_position_1", permute(kMotor, {1, 2, 0})},
      {"CircleOfMotorsTheOtherWay", "motor_position_1", permute(kMotor, {2, 0, 1})},
      {"CircleOfJoints", "joint_position_1", permute(kJoint, {1, 2, 0})},
      {"CircleOfTorques", "motor_torque_1", permute(kTorque, {2, 0, 1})},
      {"CircleOfMotorsWithoutSensors", "motor_position_1", blind(permute(kMotor, {1, 2, 0}))},
      {"MotorForItsJoint", "motor_position_1", exchange(kMotor, kJoint, 0)},
      {"MotorForItsLinearJoint", "motor_position_3", exchange(kMotor, kJoint, 2)},
      {"TorqueForItsMotor", "motor_position_2", exchange(kTorque, kMotor, 1)},
      {"TorqueForItsJoint", "joint_position_2", exchange(kTorque, kJoint, 1)},
      {"TorqueForItsMotorWithoutSensors", "motor_position_2", blind(exchange(kTorque, kMotor, 1))},
  };
}

std::vector<Spoilt> clocks_and_sensors() {
  return {
      {"TimeInMilliseconds", "time", time_in(1e-3)},
      {"TimeInMicroseconds", "time", time_in(1e-6)},
      {"TimeInNanoseconds", "time", time_in(1e-9)},
      {"TimeInMinutes", "time", time_in(60)},
      {"JointThatFreezes", "joint_position_1", hold(kJoint, 0, 2000, 3500)},
      {"DeadJoint", "joint_position_2", hold(kJoint, 1, 0, 6001)},
      {"SaturatedJoint", "joint_position_2", saturate(kJoint, 1, 0.7)},
      {"TorqueThatFreezes", "motor_torque_2", hold(kTorque, 1, 2000, 3500)},
      {"ConstantTorque", "motor_torque_1", hold(kTorque, 0, 0, 6001)},
  };
}

const auto kNameOf = [](const ::testing::TestParamInfo<Spoilt>& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(SignsAndUnits, Remedy, ::testing::ValuesIn(signs_and_units()), kNameOf);
INSTANTIATE_TEST_SUITE_P(ZerosAndCounters, Remedy, ::testing::ValuesIn(zeros_and_counters()), kNameOf);
INSTANTIATE_TEST_SUITE_P(Exchanges, Remedy, ::testing::ValuesIn(exchanges()), kNameOf);
INSTANTIATE_TEST_SUITE_P(ClocksAndSensors, Remedy, ::testing::ValuesIn(clocks_and_sensors()), kNameOf);

}  // namespace
}  // namespace halyard

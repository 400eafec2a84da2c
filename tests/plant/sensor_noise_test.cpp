/// The noise of the sensors in a scenario file, and in the log of its simulation.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "plant/scenario.h"
#include "plant/simulate.h"
#include "tests/support/message_of.h"

namespace halyard {
namespace {

class SensorNoise : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }

  /// A second of the RAVEN-II at rest with these sensors.
  Scenario read(const std::string& sensors) const {
    std::ofstream(file_) << "<scenario name=\"s\" model=\"" HALYARD_SOURCE_DIR
                            "/examples/raven2/raven2.xml\" duration=\"1\" engine=\"halyard\">\n"
                         << sensors << "\n</scenario>\n";
    return read_scenario(file_);
  }
  std::string message(const std::string& sensors) const {
    return message_of([&] { read(sensors); });
  }

  const std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("halyard_sensor_noise_" + std::to_string(::getpid()) + ".xml");
};

TEST_F(SensorNoise, IsGivenForAllJointsOrForEach) {
  const TickNoise noise =
      read(R"(<sensors torque_noise="1e-3" motor_position_noise="0.5 deg" joint_position_noise="1e-4 2e-4 3e-5"/>)")
          .noise;
  EXPECT_EQ(noise.motor_torque, (std::vector<double>{1e-3, 1e-3, 1e-3}));
  EXPECT_EQ(noise.motor_reading, (std::vector<double>(3, 0.5 * std::numbers::pi / 180)));
  EXPECT_EQ(noise.joint_reading, (std::vector<double>{1e-4, 2e-4, 3e-5}));
  EXPECT_EQ(
      message(R"(<sensors joint_position_noise="1e-4 2e-4"/>)"),
      file_.string() +
          ":2: <sensors joint_position_noise=\"1e-4 2e-4\">: expected one number, or one for each of the 3 joints "
          "with blanks between, none of them negative");
  EXPECT_NE(message(R"(<sensors torque_noise="-1e-3"/>)").find("none of them negative"), std::string::npos);
}

TEST_F(SensorNoise, OfAJointIsInItsReadingAlone) {
  const SimulationResult quiet = simulate(read("<sensors quantise=\"false\"/>"));
  const SimulationResult noisy = simulate(read(R"(<sensors quantise="false" joint_position_noise="0 1e-3 0"/>)"));
  EXPECT_EQ(noisy.truth.joint_position, quiet.truth.joint_position);
  EXPECT_EQ(noisy.measured.motor_position, quiet.measured.motor_position);
  EXPECT_EQ(noisy.measured.joint_position[0], quiet.measured.joint_position[0]);
  const std::vector<double>&read = noisy.measured.joint_position[1], &truth = noisy.truth.joint_position[1];
  double squares = 0;
  for (std::size_t i = 0; i < read.size(); ++i) squares += (read[i] - truth[i]) * (read[i] - truth[i]);
  // The relative deviation of s from n draws is 1 / sqrt(2 n): 2.2 % at 1001. Four of them.
  EXPECT_NEAR(std::sqrt(squares / double(read.size())), 1e-3, 0.09e-3);
}

}  // namespace
}  // namespace halyard

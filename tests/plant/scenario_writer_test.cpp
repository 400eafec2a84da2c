// What scenario_xml() writes, read_scenario() reads as the same scenario.
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "model/model_file.h"
#include "plant/scenario.h"
#include "tests/support/temporary_folder.h"

namespace halyard {
namespace {

const std::string kRaven = HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml";

Scenario raven_scenario() {
  Scenario s;
  s.robot = read_model(kRaven);
  s.assumed = s.robot;
  s.name = "sines & \"moves\"";
  s.duration_s = 3;
  s.seed = 7;
  s.trajectory.resize(3);
  for (int k = 0; k < 3; ++k) s.trajectory[k].center = s.robot.joints[k].home;
  return s;
}

Scenario read_again(const Scenario& scenario, const TemporaryFolder& folder) {
  std::ofstream(folder / "again.xml") << scenario_xml(scenario, kRaven, folder);
  return read_scenario(folder / "again.xml");
}

void expect_same(const JointTrajectory& a, const JointTrajectory& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.center, b.center);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.move_s, b.move_s);
  EXPECT_EQ(a.dwell_s, b.dwell_s);
  EXPECT_EQ(a.sample_time, b.sample_time);
  EXPECT_EQ(a.sample_position, b.sample_position);
  ASSERT_EQ(a.sines.size(), b.sines.size());
  for (std::size_t i = 0; i < a.sines.size(); ++i) {
    EXPECT_EQ(a.sines[i].amplitude, b.sines[i].amplitude);
    EXPECT_EQ(a.sines[i].frequency_hz, b.sines[i].frequency_hz);
    EXPECT_EQ(a.sines[i].phase, b.sines[i].phase);
  }
}

TEST(ScenarioWriter, WritesEveryKindOfMotion) {
  const TemporaryFolder folder;
  std::ofstream(folder / "joint 3.csv") << "time,position\n0,0.3\n1.5,0.31\n3,0.3\n";
  Scenario s = raven_scenario();
  s.trajectory[0] = {.kind = JointTrajectory::Kind::sines, .center = 0.5, .sines = {{0.1, 0.3, 0}, {0.05, 1. / 3, -2}}};
  s.trajectory[1] = {
      .kind = JointTrajectory::Kind::point_to_point, .points = {1.4, 1.6, 1.5}, .move_s = 0.7, .dwell_s = 0};
  s.trajectory[2] = {.kind = JointTrajectory::Kind::samples,
                     .sample_time = {0, 1.5, 3},
                     .sample_position = {0.3, 0.31, 0.3},
                     .file = folder / "joint 3.csv",
                     .column = "position"};
  const Scenario again = read_again(s, folder);
  EXPECT_EQ(again.name, s.name);
  EXPECT_EQ(again.duration_s, s.duration_s);
  EXPECT_EQ(again.seed, s.seed);
  EXPECT_EQ(model_to_xml(again.robot), model_to_xml(s.robot));
  for (std::size_t k = 0; k < 3; ++k) expect_same(again.trajectory[k], s.trajectory[k]);
}

TEST(ScenarioWriter, WritesControlSensorsAndCamera) {
  const TemporaryFolder folder;
  Scenario s = raven_scenario();
  s.control_period_s = 2e-3;
  s.fade_in_s = 0.5;
  s.quantise = false;
  s.homed = true;
  s.noise.motor_torque = {1e-3, 2e-3, 0};
  s.noise.motor_reading = {1e-4, 1e-4, 1e-4};
  s.noise.joint_reading = {1e-5, 0, 2e-5};
  s.camera = Camera{.rate_hz = 25, .latency_s = 0.04, .noise_m = 1e-3, .dropout = 0.2};
  const Scenario again = read_again(s, folder);
  EXPECT_EQ(again.control_period_s, s.control_period_s);
  EXPECT_EQ(again.fade_in_s, s.fade_in_s);
  EXPECT_EQ(again.quantise, s.quantise);
  EXPECT_EQ(again.homed, s.homed);
  EXPECT_EQ(again.noise.motor_torque, s.noise.motor_torque);
  EXPECT_EQ(again.noise.motor_reading, s.noise.motor_reading);
  EXPECT_EQ(again.noise.joint_reading, s.noise.joint_reading);
  ASSERT_TRUE(again.camera);
  EXPECT_EQ(again.camera->rate_hz, s.camera->rate_hz);
  EXPECT_EQ(again.camera->latency_s, s.camera->latency_s);
  EXPECT_EQ(again.camera->noise_m, s.camera->noise_m);
  EXPECT_EQ(again.camera->dropout, s.camera->dropout);
}

TEST(ScenarioWriter, WritesHowThePlantIsComputed) {
  const TemporaryFolder folder;
  Scenario s = raven_scenario();
  s.integrator.relative_tolerance = 1e-5;
  const Scenario usual = read_again(s, folder);
  EXPECT_FALSE(usual.engine);
  EXPECT_EQ(usual.integrator.kind, IntegratorKind::automatic);
  EXPECT_EQ(usual.integrator.relative_tolerance, 1e-5);
  s.engine = Engine::simbody;
  s.integrator.kind = IntegratorKind::simbody_rkm;
  const Scenario chosen = read_again(s, folder);
  EXPECT_EQ(chosen.engine, Engine::simbody);
  EXPECT_EQ(chosen.integrator.kind, IntegratorKind::simbody_rkm);
}

TEST(ScenarioWriter, RefusesNoiseOfTheJointsForces) {
  Scenario s = raven_scenario();
  s.noise.joint_force = {0.1, 0.1, 0.1};
  EXPECT_THROW(scenario_xml(s, kRaven, "."), std::invalid_argument);
}

TEST(ScenarioWriter, RefusesSamplesThatAreInNoFile) {
  Scenario s = raven_scenario();
  s.trajectory[0] = {.kind = JointTrajectory::Kind::samples, .sample_time = {0, 1}, .sample_position = {0, 0}};
  EXPECT_THROW(scenario_xml(s, kRaven, "."), std::invalid_argument);
}

}  // namespace
}  // namespace halyard

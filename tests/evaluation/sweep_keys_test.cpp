/// What the keys of a sweep's axes name: numbers of the arm, of the scenario, and of the estimators.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "evaluation/sweep/parameters/axis_keys.h"
#include "evaluation/sweep/parameters/scenario_number.h"
#include "evaluation/sweep/sweep_file.h"
#include "evaluation/sweep/sweep_parameter.h"
#include "model/model_file.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;
const std::string kRaven = HALYARD_SOURCE_DIR "/examples/raven2/";

Scenario camera_scenario() { return read_scenario(kRaven + "camera.xml"); }

SweepAxis axis_of(const std::string& key, double value, SweepAxis::Target target = SweepAxis::Target::both) {
  SweepAxis axis;
  axis.parameters = {key};
  axis.applies_to = target;
  axis.values = {value};
  return axis;
}

SweepGrid grid_of(const SweepAxis& axis) {
  SweepGrid grid;
  grid.axes = {axis};
  return grid;
}

/// The scenario with this number.
Scenario with(const std::string& key, double value, Scenario scenario = camera_scenario()) {
  put_values(grid_of(axis_of(key, value)), 0, scenario);
  return scenario;
}

std::string unit_of(const std::string& key, SweepAxis axis) {
  const Scenario scenario = camera_scenario();
  return unit_of_key(key, axis, scenario, read_model(kRaven + "raven2.xml"), {"ekf"});
}
std::string refusal(const std::string& key, SweepAxis::Target target = SweepAxis::Target::both) {
  return message_of([&] { unit_of(key, axis_of(key, 1, target)); });
}

TEST(SweepKeys, NameAnOptionOfAModuleWhateverItsFileIsCalled) {
  const Scenario scenario = camera_scenario();
  const ArmModel model = read_model(kRaven + "raven2.xml");
  const std::string key = "estimator.mine.alpha";
  EXPECT_EQ(message_of([&] { unit_of_key(key, axis_of(key, 1), scenario, model, {"./mine.so.1"}); }), "no InputError");
}

TEST(SweepKeys, NameTheResolutionOfAnEncoder) {
  ArmModel model = read_model(kRaven + "raven2.xml");
  model_parameter(model, "joint3.encoders.joint_resolution").set(2e-5);
  EXPECT_EQ(model.nominal.joint[2].joint_encoder_resolution, 2e-5);
  model_parameter(model, "joint1.encoders.motor_resolution").set(1e-2);
  EXPECT_EQ(model.nominal.joint[0].motor_encoder_resolution, 1e-2);
  EXPECT_EQ(parameter_unit(model, "joint1.encoders.joint_resolution"), "rad");
  EXPECT_EQ(parameter_unit(model, "joint3.encoders.joint_resolution"), "m");
  model.nominal.joint[0].motor_zero_known = false;
  EXPECT_TRUE(message_of([&] { model_parameter(model, "joint1.encoders.motor_offset"); }).find("none of that name") !=
              std::string::npos)
      << "an offset that the model does not know cannot be varied";
}

TEST(SweepKeys, NameASmoothingSpeedAndAGainOfTheController) {
  ArmModel model = read_model(kRaven + "raven2.xml");
  model_parameter(model, "joint2.friction.smoothing").set(1e-3);
  EXPECT_EQ(model.nominal.joint[1].joint_smoothing, 1e-3);
  model_parameter(model, "joint2.controller.kd").set(7e-4);
  EXPECT_EQ(model.joints[1].controller.kd, 7e-4);
}

TEST(SweepKeys, NameTheNoiseOfASensor) {
  const Scenario varied = with("joint2.sensors.joint_position_noise", 1e-4);
  EXPECT_EQ(varied.noise.joint_reading, (std::vector<double>{0, 1e-4, 0}));
  EXPECT_EQ(with("joint1.sensors.motor_position_noise", 2e-3).noise.motor_reading[0], 2e-3);
  EXPECT_EQ(with("joint3.sensors.torque_noise", 3e-3).noise.motor_torque[2], 3e-3);
  const TickNoise none = with("joint3.sensors.torque_noise", 0).noise;
  EXPECT_TRUE(none.motor_torque.empty() && none.motor_reading.empty() && none.joint_reading.empty())
      << "would draw random numbers";
}

TEST(SweepKeys, NameNumbersOfTheScenario) {
  EXPECT_EQ(with("control.period", 2e-3).control_period_s, 2e-3);
  EXPECT_EQ(with("integrator.relative_tolerance", 1e-5).integrator.relative_tolerance, 1e-5);
  EXPECT_EQ(with("camera.latency", 0.1).camera->latency_s, 0.1);
  EXPECT_EQ(with("joint1.trajectory.sine1.frequency", 0.7).trajectory[0].sines[0].frequency_hz, 0.7);
  EXPECT_EQ(with("joint1.trajectory.sine1.amplitude", 0.2).trajectory[0].sines[0].amplitude, 0.2);
  EXPECT_EQ(with("joint1.trajectory.sine1.phase", 0.4).trajectory[0].sines[0].phase, 0.4);
  const Scenario moves = read_scenario(kRaven + "experiment_a.xml");
  EXPECT_EQ(with("joint2.trajectory.center", 1.5, moves).trajectory[1].center, 1.5);
}

TEST(SweepKeys, NameTheTimesOfMovesBetweenPoints) {
  Scenario moves = camera_scenario();
  moves.trajectory[1].kind = JointTrajectory::Kind::point_to_point;
  moves.trajectory[1].points = {1, 2};
  EXPECT_EQ(with("joint2.trajectory.move", 0.75, moves).trajectory[1].move_s, 0.75);
  EXPECT_EQ(with("joint2.trajectory.dwell", 0.25, moves).trajectory[1].dwell_s, 0.25);
  const SweepGrid grid = grid_of(axis_of("joint2.trajectory.dwell", -1));
  put_values(grid, 0, moves);
  EXPECT_EQ(message_of([&] { check_varied_scenario(grid, moves); }),
            "joint2.trajectory.dwell = -1 s: expected a number of at least 0");
}

TEST(SweepKeys, OfAnEffectNameAPlaceThatItCanHave) {
  ArmModel model = read_model(kRaven + "raven2.xml");
  const auto refused = [&](const std::string& key) { return message_of([&] { model_parameter(model, key); }); };
  EXPECT_EQ(refused("arm.effect.backlash.half_gap"),
            "parameter 'arm.effect.backlash.half_gap': the effect is of a joint; write "
            "jointK.effect.backlash.half_gap with K from 1 to 3");
  EXPECT_EQ(refused("joint4.effect.backlash.half_gap"),
            "parameter 'joint4.effect.backlash.half_gap': the effect is of a joint; write "
            "jointK.effect.backlash.half_gap with K from 1 to 3");
  for (const std::string joint : {"joint02", "joint0", "joint-1", "joint-2147483648"})
    EXPECT_TRUE(refused(joint + ".effect.backlash.half_gap").ends_with("with K from 1 to 3")) << joint;
  EXPECT_NE(refused("joint+2.effect.backlash.half_gap"), "no InputError");
  EXPECT_TRUE(refused("joint1.effect.backlsh.half_gap")
                  .starts_with("parameter 'joint1.effect.backlsh.half_gap': unknown effect; expected one of "));
  model.nominal.joint[1].drive = Drive::rigid;
  const std::string without_cable = refused("joint2.effect.backlash.half_gap");
  EXPECT_TRUE(without_cable.ends_with("; name another joint")) << without_cable;
}

TEST(SweepKeys, NameAnOptionOfAnEstimator) {
  ArmModel model = read_model(kRaven + "raven2.xml");
  put_values(grid_of(axis_of("estimator.ekf.torque_noise", 2.5e-3)), 0, model);
  EXPECT_EQ(model.estimators.at("ekf").at("torque_noise"), "0.0025");
  SweepAxis factor = axis_of("estimator.ekf.torque_noise", 4);
  factor.is_factor = true;
  put_values(grid_of(factor), 0, model);
  EXPECT_EQ(model.estimators.at("ekf").at("torque_noise"), "0.01");
}

TEST(SweepKeys, HaveTheUnitOfTheirNumber) {
  for (const auto& [key, unit] :
       std::vector<std::pair<std::string, std::string>>{{"joint1.sensors.joint_position_noise", "rad"},
                                                        {"joint3.sensors.joint_position_noise", "m"},
                                                        {"camera.rate", "Hz"},
                                                        {"estimator.ekf.torque_noise", ""},
                                                        {"joint1.cable.stiffness", "N/m"}})
    EXPECT_EQ(unit_of(key, axis_of(key, 1)), unit) << key;
}

TEST(SweepKeys, ThatFitNothingAreRefusedWithWhatWouldFit) {
  const auto expect = [](const std::string& message, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect(refusal("control.perid"), {"'control.perid'", "control.period"});
  expect(refusal("joint1.sensors.noise"), {"joint1.sensors.torque_noise"});
  expect(refusal("control.period", SweepAxis::Target::model), {"not of the model", "leave out applies_to"});
  expect(refusal("estimator.sr_ukf.alpha"), {"does not run this estimator", "ekf"});
  expect(refusal("estimator.ekf"), {"estimator.NAME.OPTION"});
  expect(refusal("estimator.ekf.torque_noise", SweepAxis::Target::robot), {"not of the robot"});
  SweepAxis factor = axis_of("estimator.ekf.torque_noise", 2);
  factor.is_factor = true;
  expect(message_of([&] { unit_of("estimator.ekf.torque_noise", factor); }), {"nothing to multiply"});
}

TEST(SweepKeys, OfTheModelAreThoseOfTheControllerToo) {
  const std::string key = "joint2.motor.capstan_radius";
  const auto radius_with = [&](SweepAxis::Target target) {
    Scenario scenario = camera_scenario();
    put_values(grid_of(axis_of(key, 7e-3, target)), 0, scenario);
    return scenario.assumed->nominal.joint[1].capstan_radius;
  };
  const double given = camera_scenario().assumed->nominal.joint[1].capstan_radius;
  EXPECT_EQ(radius_with(SweepAxis::Target::both), 7e-3);
  EXPECT_EQ(radius_with(SweepAxis::Target::model), 7e-3);
  EXPECT_EQ(radius_with(SweepAxis::Target::robot), given);
}

TEST(SweepKeys, OfAScenarioAreCheckedAtEachPoint) {
  const SweepGrid grid = grid_of(axis_of("camera.dropout", 1.5));
  Scenario scenario = camera_scenario();
  put_values(grid, 0, scenario);
  EXPECT_EQ(message_of([&] { check_varied_scenario(grid, scenario); }),
            "camera.dropout = 1.5: expected a share from 0 to 1");
}

TEST(SweepFile, IsAnotherSweepWithAnotherBuildOfAModule) {
  const TemporaryFolder folder;
  const auto id_with = [&](const std::string& module) {
    std::ofstream(folder / "mine.so") << module;
    std::ofstream(folder / "sweep.xml") << "<sweep name=\"s\" scenario=\"" << kRaven
                                        << "experiment_a.xml\" estimators=\"ekf,./mine.so\"><axis "
                                           "parameter=\"joint1.cable.stiffness\" values=\"1e5 2e5\"/></sweep>";
    return read_sweep_definition(folder / "sweep.xml").grid.id;
  };
  const std::string id = id_with("one build");
  EXPECT_EQ(id_with("one build"), id);
  EXPECT_NE(id_with("other build"), id);
}

TEST(SweepFile, IsAnotherSweepWithAnotherModelOfTheController) {
  const TemporaryFolder folder;
  std::ofstream(folder / "scenario.xml") << "<scenario name=\"s\" model=\"arm.xml\"><set "
                                            "parameter=\"joint1.motor.capstan_radius\" value=\"6e-3\"/></scenario>";
  std::ofstream(folder / "sweep.xml") << "<sweep name=\"s\" scenario=\"scenario.xml\" model=\"" << kRaven
                                      << "raven2.xml\" estimators=\"ekf\"><axis "
                                         "parameter=\"joint1.cable.stiffness\" values=\"1e5 2e5\"/></sweep>";
  // Robot and estimators stay as they are: the scenario sets the robot's radius, the estimators have another model.
  const auto id_with = [&](double capstan_radius) {
    ArmModel arm = read_model(kRaven + "raven2.xml");
    arm.nominal.joint[0].capstan_radius = capstan_radius;
    std::ofstream(folder / "arm.xml") << model_to_xml(arm);
    return read_sweep_definition(folder / "sweep.xml").grid.id;
  };
  const std::string id = id_with(5e-3);
  EXPECT_EQ(id_with(5e-3), id);
  EXPECT_NE(id_with(7e-3), id);
}

}  // namespace
}  // namespace halyard

#include "evaluation/sweep/parameters/scenario_number.h"

#include <fmt/core.h>

#include "model/input_error.h"

namespace halyard {
namespace {

using Range = ScenarioNumber::Range;

const char* position_unit(const Scenario& scenario, std::size_t k) {
  return scenario.robot.nominal.joint[k].type == JointType::revolute ? "rad" : "m";
}

void add_trajectory(Scenario& scenario, std::size_t k, std::vector<ScenarioNumber>& all) {
  const std::string part = fmt::format("joint{}.trajectory.", k + 1), unit = position_unit(scenario, k);
  JointTrajectory& t = scenario.trajectory[k];
  using Kind = JointTrajectory::Kind;
  if (t.kind == Kind::hold || t.kind == Kind::sines) all.push_back({part + "center", unit, Range::any, &t.center});
  for (std::size_t i = 0; i < t.sines.size(); ++i) {
    const std::string sine = fmt::format("{}sine{}.", part, i + 1);
    all.push_back({sine + "amplitude", unit, Range::any, &t.sines[i].amplitude});
    all.push_back({sine + "frequency", "Hz", Range::positive, &t.sines[i].frequency_hz});
    all.push_back({sine + "phase", "rad", Range::any, &t.sines[i].phase});
  }
  if (t.kind != Kind::point_to_point) return;
  all.push_back({part + "move", "s", Range::positive, &t.move_s});
  all.push_back({part + "dwell", "s", Range::not_negative, &t.dwell_s});
}

void add_sensors(Scenario& scenario, std::size_t k, std::vector<ScenarioNumber>& all) {
  const std::string part = fmt::format("joint{}.sensors.", k + 1);
  TickNoise& noise = scenario.noise;
  if (scenario.robot.nominal.joint[k].drive != Drive::none) {
    all.push_back({part + "torque_noise", "N m", Range::not_negative, &noise.motor_torque[k]});
    all.push_back({part + "motor_position_noise", "rad", Range::not_negative, &noise.motor_reading[k]});
  }
  all.push_back(
      {part + "joint_position_noise", position_unit(scenario, k), Range::not_negative, &noise.joint_reading[k]});
}

}  // namespace

std::vector<ScenarioNumber> scenario_numbers(Scenario& scenario) {
  std::vector<ScenarioNumber> all = {
      {"control.period", "s", Range::positive, &scenario.control_period_s},
      {"control.fade_in", "s", Range::not_negative, &scenario.fade_in_s},
      {"integrator.relative_tolerance", "", Range::positive, &scenario.integrator.relative_tolerance},
      {"integrator.absolute_tolerance", "", Range::positive, &scenario.integrator.absolute_tolerance}};
  if (scenario.camera) {
    Camera& camera = *scenario.camera;
    all.push_back({"camera.rate", "Hz", Range::positive, &camera.rate_hz});
    all.push_back({"camera.latency", "s", Range::not_negative, &camera.latency_s});
    all.push_back({"camera.noise", "m", Range::not_negative, &camera.noise_m});
    all.push_back({"camera.dropout", "", Range::share, &camera.dropout});
  }
  const std::size_t n = scenario.trajectory.size();
  for (std::vector<double>* noise :
       {&scenario.noise.motor_torque, &scenario.noise.motor_reading, &scenario.noise.joint_reading})
    noise->resize(n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    add_sensors(scenario, k, all);
    add_trajectory(scenario, k, all);
  }
  return all;
}

void check_range(const ScenarioNumber& number) {
  const double x = *number.value;
  const auto expect = [&](bool is_right, const char* expected) {
    if (is_right) return;
    throw InputError(fmt::format("{} = {:g}{}{}: expected {}", number.key, x, number.unit.empty() ? "" : " ",
                                 number.unit, expected));
  };
  switch (number.range) {
    case Range::any: break;
    case Range::not_negative: expect(x >= 0, "a number of at least 0"); break;
    case Range::positive: expect(x > 0, "a number above 0"); break;
    case Range::share: expect(x >= 0 && x <= 1, "a share from 0 to 1"); break;
  }
}

}  // namespace halyard

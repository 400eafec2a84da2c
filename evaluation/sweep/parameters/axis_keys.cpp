#include "evaluation/sweep/parameters/axis_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "evaluation/sweep/parameters/estimator_option.h"
#include "evaluation/sweep/parameters/scenario_number.h"
#include "evaluation/sweep/sweep_parameter.h"
#include "model/input_error.h"
#include "model/name_list.h"
#include "plugins/host/loader.h"

namespace halyard {
namespace {

using Target = SweepAxis::Target;

/// Whether the key's part, such as "sensors" of "joint1.sensors.torque_noise", is one of a scenario.
bool is_of_scenario(std::string_view key) {
  constexpr std::array<std::string_view, 5> kParts = {"control", "integrator", "camera", "sensors", "trajectory"};
  if (key.starts_with("joint")) key.remove_prefix(std::min(key.find('.'), key.size() - 1) + 1);
  return std::ranges::find(kParts, key.substr(0, key.find('.'))) != kParts.end();
}

bool is_option(const std::string& key) { return parse_option_key(key).has_value(); }

[[noreturn]] void fail(const std::string& key, const std::string& what) {
  throw InputError("parameter " + in_quotes(key) + ": " + what);
}

double& scenario_number(Scenario& scenario, const std::string& key) {
  const std::vector<ScenarioNumber> all = scenario_numbers(scenario);
  return *std::ranges::find(all, key, &ScenarioNumber::key)->value;
}

std::string scenario_unit(const std::string& key, const SweepAxis& axis, Scenario scenario) {
  const std::vector<ScenarioNumber> all = scenario_numbers(scenario);
  const auto found = std::ranges::find(all, key, &ScenarioNumber::key);
  if (found == all.end()) {
    std::vector<std::string> keys;
    for (const ScenarioNumber& number : all) keys.push_back(number.key);
    fail(key, fmt::format("the scenario has none of that name; expected one of {}", listed(keys)));
  }
  if (axis.applies_to == Target::model) fail(key, "is of the scenario and not of the model; leave out applies_to");
  return found->unit;
}

void check_option(const std::string& key, const SweepAxis& axis, const ArmModel& model,
                  const std::vector<std::string>& estimators) {
  const EstimatorOptionKey option = *parse_option_key(key);
  const auto may_have_it = [&](const std::string& name) {
    return name == option.estimator || is_module_path(name);  // a module says its name when it is loaded
  };
  if (estimators.empty()) fail(key, "a sweep of limits runs no estimator; remove this axis");
  if (std::ranges::none_of(estimators, may_have_it))
    fail(key, fmt::format("the sweep does not run this estimator; expected one of {}", listed(estimators)));
  if (axis.applies_to == Target::robot) fail(key, "is of an estimator and not of the robot; leave out applies_to");
  if (axis.is_factor && !option_number(model, option))
    fail(key,
         "the model does not give this option as one number, so that there is nothing to multiply; leave out factor");
}

/// The arm's numbers of the axes that apply to this target.
void put_arm_values(const SweepGrid& grid, std::size_t point, Target target, ArmModel& model) {
  const std::vector<double> values = grid.values(point);
  for (std::size_t i = 0; i < grid.axes.size(); ++i) {
    const SweepAxis& axis = grid.axes[i];
    if (axis.applies_to != target && axis.applies_to != Target::both) continue;
    for (const std::string& key : axis.parameters) {
      if (is_of_scenario(key) || is_option(key)) continue;
      const ArmNumber number = model_parameter(model, key);
      number.set(axis.is_factor ? number.get() * values[i] : values[i]);
    }
  }
}

}  // namespace

std::string unit_of_key(const std::string& key, const SweepAxis& axis, const Scenario& scenario, const ArmModel& model,
                        const std::vector<std::string>& estimators) {
  if (is_option(key)) {
    check_option(key, axis, model, estimators);
    return "";
  }
  if (is_of_scenario(key)) return scenario_unit(key, axis, scenario);
  parameter_unit(scenario.robot, key);  // the robot may lack what the model has
  return parameter_unit(model, key);
}

bool is_zero(const std::string& key, const SweepAxis& axis, Scenario scenario, ArmModel model) {
  if (const auto option = parse_option_key(key)) return option_number(model, *option) == 0;
  if (is_of_scenario(key)) return scenario_number(scenario, key) == 0;
  return (axis.applies_to == Target::model || model_parameter(scenario.robot, key).get() == 0) &&
         (axis.applies_to == Target::robot || model_parameter(model, key).get() == 0);
}

void put_values(const SweepGrid& grid, std::size_t point, Scenario& scenario) {
  put_arm_values(grid, point, Target::robot, scenario.robot);
  // The controller has the scenario's model, which is varied with that of the estimators.
  if (scenario.assumed) put_arm_values(grid, point, Target::model, *scenario.assumed);
  const std::vector<double> values = grid.values(point);
  for (std::size_t i = 0; i < grid.axes.size(); ++i)
    for (const std::string& key : grid.axes[i].parameters) {
      if (!is_of_scenario(key)) continue;
      double& number = scenario_number(scenario, key);
      number = grid.axes[i].is_factor ? number * values[i] : values[i];
    }
  // No noise draws no random numbers: the others stay those of the scenario.
  for (std::vector<double>* noise :
       {&scenario.noise.motor_torque, &scenario.noise.motor_reading, &scenario.noise.joint_reading})
    if (std::ranges::all_of(*noise, [](double s) { return s == 0; })) noise->clear();
}

void put_values(const SweepGrid& grid, std::size_t point, ArmModel& model) {
  put_arm_values(grid, point, Target::model, model);
  const std::vector<double> values = grid.values(point);
  for (std::size_t i = 0; i < grid.axes.size(); ++i)
    for (const std::string& key : grid.axes[i].parameters) {
      const auto option = parse_option_key(key);
      if (!option) continue;
      set_option(model, *option, values[i] * (grid.axes[i].is_factor ? option_number(model, *option).value() : 1));
    }
}

void check_varied_scenario(const SweepGrid& grid, const Scenario& scenario) {
  std::vector<std::string> varied;
  for (const SweepAxis& axis : grid.axes)
    std::ranges::copy_if(axis.parameters, std::back_inserter(varied), is_of_scenario);
  if (varied.empty()) return;
  Scenario copy = scenario;
  const std::vector<ScenarioNumber> all = scenario_numbers(copy);
  for (const std::string& key : varied) check_range(*std::ranges::find(all, key, &ScenarioNumber::key));
  check_scenario(scenario);
}

}  // namespace halyard

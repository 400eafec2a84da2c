#pragma once
/// What the keys of a sweep's axes name, and how a point's values get there. A key names a number of
///
///   the arm         ../sweep_parameter.h   of the robot, of the model, or of both, as the axis says
///   the scenario    scenario_number.h      of the simulation; the axis applies to robot or both
///   an estimator    estimator_option.h     of the model; the axis applies to model or both

#include <string>
#include <vector>

#include "evaluation/sweep/sweep_grid.h"
#include "model/arm_model.h"
#include "plant/scenario.h"

namespace halyard {

/// SI unit of the values of a key; empty for a pure number.
/// Throws InputError if robot, scenario and model have no such number, if none of the estimators can have the option,
/// if the axis applies to something else, or if it multiplies an option that the model does not give.
std::string unit_of_key(const std::string& key, const SweepAxis& axis, const Scenario& scenario, const ArmModel& model,
                        const std::vector<std::string>& estimators);

/// Whether a factor of the key's number, where the axis applies, is always zero: a noise, for example, that the
/// scenario does not have. For a key that unit_of_key() accepts.
bool is_zero(const std::string& key, const SweepAxis& axis, Scenario scenario, ArmModel model);

/// Puts a point's values into the robot and the scenario, or into the model of the estimators. A noise that is zero for
/// all joints becomes none.
void put_values(const SweepGrid& grid, std::size_t point, Scenario& scenario);
void put_values(const SweepGrid& grid, std::size_t point, ArmModel& model);

/// Throws InputError if the grid varies a number of the scenario and this scenario cannot be run.
void check_varied_scenario(const SweepGrid& grid, const Scenario& scenario);

}  // namespace halyard

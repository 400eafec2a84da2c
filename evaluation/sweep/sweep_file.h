#pragma once

#include <filesystem>

#include "evaluation/sweep/sweep_grid.h"
#include "model/arm_model.h"
#include "plant/scenario.h"

namespace halyard {

/// A sweep file, read: the grid and what stands in its middle.
///
///   <sweep name="Cable stiffness" scenario="experiment_a.xml" estimators="kinematics,sr_ukf">
///     <axis parameter="joint2.cable.stiffness" values="44e3 88e3 176e3"/>
///     <axis parameter="joint1.cable.tension joint2.cable.tension" factor="true" from="0.25" to="4" steps="5"
///           scale="log" applies_to="robot"/>
///   </sweep>
///
///   scenario     file of the scenario                          relative to the sweep file
///   model        what the estimators believe                   default: the scenario's own model file
///   estimators   names or plug-ins, with commas                a path is relative to the sweep file
///   seed, duration   go over the scenario's                    -, s
///   skip         start that errors leave out                   s, default 0.5
///   parameter    one or more keys, see sweep_parameter.h
///   values       or from, to, steps and scale (linear or log)  SI
///   factor       true: values multiply the number of the file  default false
///   applies_to   robot, model or both                          default both
struct Sweep {
  SweepGrid grid;
  Scenario scenario;  ///< its robot is the truth
  ArmModel model;     ///< what the estimators believe

  /// The scenario and the model at a point of the grid.
  Scenario scenario_at(std::size_t point) const;
  ArmModel model_at(std::size_t point) const;
};

/// Throws InputError for a wrong sweep file, scenario or model, and for a point at which the robot or the model would
/// be invalid.
Sweep read_sweep(const std::filesystem::path& path);

}  // namespace halyard

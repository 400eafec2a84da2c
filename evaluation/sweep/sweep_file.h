#pragma once

#include <filesystem>

#include "evaluation/sweep/sweep_grid.h"
#include "model/arm_model.h"
#include "plant/scenario.h"

namespace halyard {

/// The content of a sweep file: the grid, and the scenario and model that it varies.
///
///   <sweep name="Cable stiffness" scenario="experiment_a.xml" estimators="kinematics,sr_ukf">
///     <axis parameter="joint2.cable.stiffness" values="44e3 88e3 176e3"/>
///     <axis parameter="joint1.cable.tension joint2.cable.tension" factor="true" from="0.25" to="4" steps="5"
///           scale="log" applies_to="robot"/>
///   </sweep>
///
///   scenario     file of the scenario                          relative to the sweep file
///   model        the estimators' model                         default: the scenario's own model file
///   estimators   names or plug-ins, separated by commas        a path is relative to the sweep file
///   limits       instead of estimators: effects whose detection limits are measured, see measures/sweep_limits.h
///   measures     what is measured of estimators, see measures/sweep_measure.h    default: errors
///   seed, duration   replace the scenario's                    -, s
///   design       grid, latin_hypercube or sobol, see sweep_design.h   default: grid
///   samples      number of combinations of values, unless the design is a grid
///   repeats      each combination is simulated with so many seeds, from `seed` on, each a point   default: 1
///   skip         time at the start that errors exclude         s, default 0.5
///   parameter    one or more keys, see parameters/axis_keys.h
///   values       or from, to, steps and scale (linear or log)  SI; of samples from, to and scale
///   factor       true: values multiply those of the model file default false
///   applies_to   robot, model or both                          default both
struct Sweep {
  SweepGrid grid;
  Scenario scenario;             ///< its robot is the truth
  ArmModel model;                ///< the estimators' model
  std::filesystem::path folder;  ///< of the sweep file; the paths of modules are relative to it

  /// An estimator of the grid by what it is opened by: its name, or the path of its module from the current folder.
  std::string opened_by(const std::string& estimator) const;
  /// The scenario and the model at a point of the grid.
  Scenario scenario_at(std::size_t point) const;
  ArmModel model_at(std::size_t point) const;
};

/// Reads a sweep file. Throws InputError if the file, the scenario or the model is invalid, and if the robot or the
/// model would be invalid at a point of the grid: at any of 2000 points, or at 1000 to 2000 of more, evenly spaced.
Sweep read_sweep(const std::filesystem::path& path);

/// The same without a look at the points.
Sweep read_sweep_definition(const std::filesystem::path& path);

/// Throws InputError if the robot, the scenario or the model is invalid at this point. source: what the message starts
/// with.
void check_point(const Sweep& sweep, std::size_t point, const std::string& source);

}  // namespace halyard

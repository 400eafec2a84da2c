#pragma once
/// Detection limits as what a sweep measures: the sizes from which a diagnosis would see and name an effect of a joint,
/// if the arm is as the model says (diagnosis/plan.h). No estimator runs.

#include <string>
#include <string_view>
#include <vector>

#include "evaluation/sweep/sweep_grid.h"
#include "model/arm_model.h"
#include "plant/scenario.h"

namespace halyard {

/// Splits a list such as "backlash,hysteresis" at the commas.
/// Throws InputError for an effect that is unknown or listed twice, that no joint of the arm can have, or that the
/// model has already.
std::vector<SweepEffect> parse_limited_effects(std::string_view text, const ArmModel& model);

/// The columns of limits_measure() of each effect at each joint: [effect][joint][column]. NaN where an effect is not
/// seen or not named at any size, and where a joint cannot have it. The log is that of planned_scenario(), with joint
/// sensors. Throws as simulate() and detection_limits() do.
std::vector<std::vector<std::vector<double>>> limits_of(const std::vector<SweepEffect>& effects,
                                                        const Scenario& scenario, const ArmModel& model);

}  // namespace halyard

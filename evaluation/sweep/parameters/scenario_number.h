#pragma once
/// Numbers of a scenario that a sweep may vary, by key:
///
///   control.period, control.fade_in                      s
///   integrator.relative_tolerance, .absolute_tolerance
///   camera.rate, .latency, .noise, .dropout              Hz, s, m, -      of a scenario with a camera
///   jointK.sensors.torque_noise                          N m              standard deviations at each tick
///   jointK.sensors.motor_position_noise                  rad
///   jointK.sensors.joint_position_noise                  rad | m
///   jointK.trajectory.center                             rad | m          of hold and sines
///   jointK.trajectory.sineI.amplitude, .frequency, .phase  rad | m, Hz, rad   of the I-th sine
///   jointK.trajectory.move, .dwell                       s                of point_to_point
///
/// The names are those of a scenario file's elements and attributes.

#include <string>
#include <vector>

#include "plant/scenario.h"

namespace halyard {

/// A number of a scenario, with the values that it may have.
struct ScenarioNumber {
  enum class Range { any, not_negative, positive, share };  ///< share: 0 to 1

  std::string key, unit;
  Range range = Range::any;
  double* value = nullptr;  ///< points into the scenario
};

/// All of the list above that this scenario has. Noises that are absent become zero.
std::vector<ScenarioNumber> scenario_numbers(Scenario& scenario);

/// Throws InputError unless the number is within its range: "control.period = -1 s: expected a number above 0".
void check_range(const ScenarioNumber& number);

}  // namespace halyard

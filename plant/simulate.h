#pragma once
/// Runs a scenario: plant, encoders, controller.

#include <functional>

#include "plant/scenario.h"

namespace halyard {

/// Energy of a run, J, each since its start: input + drop of stored = dissipated.
struct EnergyBalance {
  double input = 0;       ///< work of motor torques and external loads
  double dissipated = 0;  ///< by friction and cable damping
  double stored = 0;      ///< kinetic, gravity, elastic: now minus at the start
};

struct SimulationResult {
  Log measured;  ///< what the robot's own sensors and the joint encoders give, every control period
  Log truth;     ///< the same instants unquantised, with joint velocities
  EnergyBalance energy;
  long derivative_evaluations = 0;
};

/// progress(fraction done) is called about ten times a simulated second, if given.
/// Throws InputError if the scenario cannot be run, std::runtime_error if the integration fails (time in the message).
SimulationResult simulate(const Scenario& scenario, const std::function<void(double)>& progress = {});

}  // namespace halyard

#pragma once
/// Runs a scenario: plant, encoders, controller.

#include <functional>

#include "plant/scenario.h"

namespace halyard {

/// Energy of a run since its start, J: input = dissipated + stored.
struct EnergyBalance {
  double input = 0;       ///< work of motor torques and external loads
  double dissipated = 0;  ///< by friction, cable damping and effects; with what effects store, less what they give
  double stored = 0;      ///< change of kinetic, gravity and elastic energy of the arm itself
};

struct SimulationResult {
  Log measured;  ///< readings of the robot's own sensors and the joint encoders, every control period
  Log truth;     ///< true values at the same instants, not quantised, with joint velocities
  EnergyBalance energy;
  long derivative_evaluations = 0;
};

/// Throws InputError if a run of the scenario does not fit into this machine's memory. check_scenario() checks it, too.
void check_memory_of_run(const Scenario& scenario);

/// Runs a scenario. progress(fraction done), if given, is called about ten times per simulated second.
/// Throws InputError if the scenario cannot be run, std::runtime_error if the integration fails (time in the message).
SimulationResult simulate(const Scenario& scenario, const std::function<void(double)>& progress = {});

/// simulate(), and then the zeros of the encoders which `model` does not know are found by homing, as a lab does that
/// knows the arm by this model.
SimulationResult simulate_homed(const Scenario& scenario, const ArmModel& model,
                                const std::function<void(double)>& progress = {});

}  // namespace halyard

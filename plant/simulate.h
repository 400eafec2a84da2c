#pragma once
/// Runs a scenario: plant, encoders, controller.

#include <functional>

#include "plant/scenario.h"

namespace halyard {

/// Energy of a run since its start, J: input = dissipated + stored.
struct EnergyBalance {
  double input = 0;       ///< work of motor torques and external loads
  double dissipated = 0;  ///< by friction and cable damping
  double stored = 0;      ///< change of kinetic, gravity and elastic energy
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

/// The same as a lab logs it that knows the arm by this model: encoders whose zero the model does not know are homed.
SimulationResult simulate_homed(const Scenario& scenario, const ArmModel& model,
                                const std::function<void(double)>& progress = {});

}  // namespace halyard

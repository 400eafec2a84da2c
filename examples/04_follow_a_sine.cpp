/// 4. A whole run: the plant, its encoders, and a controller that sees the motors only.
///
///   desired joints -> motor angles (Eq. 8) -> PD at 1 kHz -> plant -> encoders -> log
///
/// Look for: the motors lag behind what is asked of them, because the robot's gains are soft; the joints are off by
/// that and by the stretch of their cables. And the run's books: what the motors put in is stored or dissipated.

#include "arm_example.h"
#include "plant/trajectory.h"

int main() {
  using namespace halyard;
  const ArmModel arm = raven2();
  const Scenario scenario = on_sines(arm, 3);
  const SimulationResult run = simulate(scenario);

  const Log& truth = run.truth;
  fmt::print("{:>6} {:>22} {:>22}\n", "t, s", "joint 2 desired", "joint 2 true");
  for (std::size_t i = 0; i < truth.size(); i += 500) {
    const double desired = desired_position(scenario.trajectory[1], scenario.fade_in_s, truth.time[i]);
    fmt::print("{:6.2f} {:>22} {:>22}\n", truth.time[i], in_units(arm, 1, desired),
               in_units(arm, 1, truth.joint_position[1][i]));
  }
  for (int k = 0; k < 3; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      sum += std::pow(
          truth.joint_position[k][i] - desired_position(scenario.trajectory[k], scenario.fade_in_s, truth.time[i]), 2);
    fmt::print("joint {} follows within {} RMS\n", k + 1, in_units(arm, k, std::sqrt(sum / truth.size())));
  }
  const EnergyBalance& e = run.energy;
  fmt::print("energy: put in {:.6f} J = stored {:.6f} J + dissipated {:.6f} J\n", e.input, e.stored, e.dissipated);
  // The integrator's tolerance is 1e-6 of each state.
  fmt::print("energy is accounted for: {}\n",
             std::abs(e.input - e.stored - e.dissipated) < 1e-4 * std::abs(e.dissipated) ? "yes" : "no");
}

/// 10. What tension does, under the exponential law: a run at stretch ±x carries T_0 e^(±a x), a = k_e / T_0.
///
/// The paper's own law carries no tension, so that its High and Low tension experiments are the same to it. Under this
/// law the same load stretches a cable of less tension less, because it stiffens sooner - and its slacker run comes
/// closer to hanging loose, which is what breaks cable drives.
///
/// Look for: the lowest tension in either run of cable 2 falls with T_0, and more than in proportion.
/// raven2/tension_sweep.xml is the same as a study for `halyard sweep`.

#include "arm_example.h"
#include "transmission/cable_law.h"
#include "transmission/coupling.h"

int main() {
  using namespace halyard;
  std::vector<double> lowest_share;
  for (const double tension : {43.1, 30.0, 17.7, 10.0, 5.0}) {
    ArmModel arm = read_model(HALYARD_EXAMPLES "/raven2/raven2_exponential.xml");
    JointParameters<double>& cable = arm.nominal.joint[1];
    cable.tension = tension;
    const SimulationResult run = simulate(on_sines(arm, 1.5));
    double lowest = tension, largest_stretch = 0;
    for (std::size_t i = 0; i < run.truth.size(); ++i) {
      double q[3], path[3];
      for (int k = 0; k < 3; ++k) q[k] = run.truth.joint_position[k][i];
      cable_path(arm.nominal, q, path);
      const double x = cable.motor_travel() * run.truth.motor_position[1][i] - path[1];
      const RunTensions<double> runs = run_tensions(cable, x, 0.0);
      lowest = std::min({lowest, runs.forward, runs.backward});
      largest_stretch = std::max(largest_stretch, std::abs(x));
    }
    lowest_share.push_back(lowest / tension);
    fmt::print("T_0 {:4.1f} N: largest stretch {:.4f} mm, lowest tension {:5.2f} N, {:4.1f} % of T_0\n", tension,
               largest_stretch * 1e3, lowest, 100 * lowest / tension);
  }
  fmt::print("less tension brings the cable closer to slack: {}\n",
             std::is_sorted(lowest_share.rbegin(), lowest_share.rend()) ? "yes" : "no");
}

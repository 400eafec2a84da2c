/// 8. Estimators as plug-ins: loaded by name, run on the same record.
///
/// A plug-in is a shared library with one exported C function; ../plugins/README.md says how to write one. A name is
/// looked for in the plug-in folders, a path (./my_filter.so) is taken as it is.
///
/// Look for: three estimators that this program was not linked against, their errors, and what a step of each costs.

#include <chrono>

#include "arm_example.h"
#include "plugins/host/loader.h"

int main() {
  using namespace halyard;
  const ArmModel arm = raven2();
  const SimulationResult run = simulate(on_sines(arm, 2));

  for (const PluginInfo& plugin : find_plugins()) fmt::print("found {}: {}\n", plugin.name, plugin.description);
  for (const char* name : {"kinematics", "ekf", "sr_ukf"}) {
    const auto estimator = make_estimator(name, arm);
    const auto start = std::chrono::steady_clock::now();
    const Eigen::VectorXd error = rms_error(*estimator, run);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    fmt::print("{:<11} {:6.1f} us a step, RMS error: joint 1 {}, joint 2 {}, joint 3 {}\n", name,
               took.count() / static_cast<double>(run.measured.size()), in_units(arm, 0, error(0)),
               in_units(arm, 1, error(1)), in_units(arm, 2, error(2)));
  }
}

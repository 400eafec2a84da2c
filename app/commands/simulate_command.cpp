#include "app/commands/simulate_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "app/output_check.h"
#include "app/progress.h"
#include "app/terminal/terminal.h"
#include "evaluation/joint_unit.h"
#include "model/log.h"
#include "model/output/output_files.h"
#include "plant/scenario.h"
#include "plant/simulate.h"

namespace halyard {
namespace {

double greatest_magnitude(const std::vector<double>& values) {
  double greatest = 0;
  for (const double value : values) greatest = std::max(greatest, std::abs(value));
  return greatest;
}

void print_joint(const SimulationResult& result, const JointUnit& unit, int k) {
  const auto [lowest, highest] = std::ranges::minmax(result.truth.joint_position[k]);
  print_out("  joint {}: {:.4g} .. {:.4g} {}", k + 1, unit.shown_per_si * lowest, unit.shown_per_si * highest,
            unit.shown);
  if (result.measured.has_motor_torque(k))
    print_out(", motor torque up to {:.4g} N m", greatest_magnitude(result.measured.motor_torque[k]));
  print_out("\n");
}

}  // namespace

std::filesystem::path truth_path(const std::filesystem::path& log) {
  std::filesystem::path path = log;
  if (path.extension() == ".csv") path.replace_extension();
  path += ".truth.csv";
  return path;
}

void run_simulate(const SimulateOptions& options) {
  const std::filesystem::path truth = truth_path(options.out);
  const auto lock = lock_output_file(options.out), lock_of_truth = lock_output_file(truth);
  const Scenario scenario = read_scenario(options.scenario, options.robot);
  for (const auto& path : {options.out, truth}) check_not_input(path);
  SimulationResult result;
  {
    Progress progress("simulate", scenario.duration_s, "s");
    result = simulate(scenario, [&](double fraction) { progress.set(fraction * scenario.duration_s); });
  }
  const std::string about = fmt::format("halyard simulate, scenario \"{}\"", scenario.name);
  OutputFiles files;
  files.add(truth, log_csv(result.truth, about + ", ground truth"));
  files.add(options.out, log_csv(result.measured, about));
  commit_outputs(files);

  print_out("scenario \"{}\": {} samples, {:g} s, {} joint{}\n", scenario.name, result.measured.size(),
            result.measured.duration(), result.measured.n_joints, result.measured.n_joints == 1 ? "" : "s");
  const std::vector<JointUnit> units = joint_units(scenario.robot);
  for (int k = 0; k < result.truth.n_joints; ++k) print_joint(result, units[k], k);
  const EnergyBalance& energy = result.energy;
  print_out("  energy: {:.6g} J put in, {:.6g} J dissipated, {:.6g} J stored, {:.2g} J unaccounted for\n", energy.input,
            energy.dissipated, energy.stored, energy.input - energy.dissipated - energy.stored);
  print_out("measured log: {}\nground truth: {}\n", options.out.string(), truth.string());
}

}  // namespace halyard

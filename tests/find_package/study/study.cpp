// study PLUGIN.so RAVEN2_FOLDER OUT_FOLDER: what the commands compare, sweep, diagnose and identify compute, from a
// program that has the installed libraries alone. Ends with 1 at the first result that is not as expected.
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "diagnosis/diagnose.h"
#include "diagnosis/plan.h"
#include "evaluation/comparison/compare.h"
#include "evaluation/comparison/monte_carlo.h"
#include "evaluation/experiments/raven_experiments.h"
#include "evaluation/studies/diagnosis_evaluation.h"
#include "evaluation/studies/effect_study.h"
#include "evaluation/studies/identification_study.h"
#include "evaluation/studies/motion_proposal.h"
#include "evaluation/sweep/sweep_file.h"
#include "evaluation/sweep/sweep_merge.h"
#include "evaluation/sweep/sweep_parameter.h"
#include "evaluation/sweep/sweep_run.h"
#include "evaluation/sweep/sweep_table.h"
#include "halyard/version.h"
#include "model/arm_log.h"
#include "model/model_file.h"
#include "plant/scenario.h"
#include "plant/simulate.h"

namespace {

using namespace halyard;
namespace fs = std::filesystem;

void expect(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error("expected: " + what);
}

Scenario short_scenario(const fs::path& raven2) {
  Scenario scenario = read_scenario(raven2 / "experiment_a.xml");
  scenario.duration_s = 1;
  return scenario;
}

/// Two plug-ins on the same data, with intervals; then over three seeds.
void compare_plugins(const std::string& plugin, const fs::path& raven2) {
  const Scenario scenario = short_scenario(raven2);
  const SimulationResult data = simulate(scenario);
  const Comparison c = compare_estimators(scenario.robot, {plugin, "sr_ukf"}, data.measured, data.truth);
  for (int k = 0; k < c.n_joints(); ++k) {
    const PairedRatio& ratio = c.paired[1][0][k];
    std::printf("joint %d: sr_ukf over alpha_beta %.3f (%.3f to %.3f)\n", k + 1, ratio.ratio, ratio.lower, ratio.upper);
    expect(ratio.lower <= ratio.ratio && ratio.ratio <= ratio.upper, "an interval around the ratio");
  }
  // The filter knows how far the torque stretches the cables, a filter of the motors' angles does not.
  expect(c.paired[1][0][1].better(), "sr_ukf better than alpha_beta at joint 2");

  const MonteCarlo runs = run_monte_carlo(scenario, scenario.robot, {plugin, "sr_ukf"}, {.runs = 3});
  expect(runs.estimators.size() == 2 && runs.estimators[1].failures == 0, "three runs of two plug-ins");
  expect(std::isfinite(runs.estimators[1].nees[0].mean), "a NEES of sr_ukf");
}

/// A grid of two points, put together here; stored in two parts, merged, and written as a table.
void sweep_stiffness(const fs::path& raven2, const fs::path& out) {
  Sweep sweep;
  sweep.scenario = short_scenario(raven2);
  sweep.model = sweep.scenario.robot;
  sweep.grid.name = "stiffness of cable 2";
  sweep.grid.id = "study";
  sweep.grid.axes = {{.parameters = {"joint2.cable.stiffness"},
                      .applies_to = SweepAxis::Target::robot,
                      .is_factor = true,
                      .unit = "",
                      .values = {0.5, 1}}};
  sweep.grid.estimators = {"sr_ukf"};
  sweep.grid.units = joint_units(sweep.model);
  for (std::size_t part : {1, 2}) run_sweep(sweep, out / std::to_string(part), {.jobs = 1, .shard = {part, 2}});
  OutputFiles files;
  const SweepResult whole = merge_sweep(files, {out / "1", out / "2"}, out / "whole");
  const SweepSummary summary = write_sweep_table(files, out / "whole/sweep.csv", whole.grid, whole.cells);
  files.commit();
  expect(summary.failures == 0, "no failure in the sweep");
  // The first measure shows the mean absolute error; of the first estimator, at joint 2.
  const auto error = [&](std::size_t point) { return whole.cells.read(point).shown(whole.grid, 0, 0, 1); };
  std::printf("joint 2 mean absolute error of sr_ukf, cable 2 at half the stiffness: %.2e rad, as believed: %.2e rad\n",
              error(0), error(1));
  // At 1 the robot is as the filter believes.
  expect(error(0) > 2 * error(1), "an error that a wrong stiffness makes");
}

/// The arm's elbow on its own.
ArmModel elbow(const fs::path& raven2) {
  ArmModel arm = read_model(raven2 / "raven2.xml");
  arm.nominal.joint[0] = arm.nominal.joint[1];
  arm.nominal.joint[0].coupling[0] = 1;
  arm.nominal.joint[0].coupling[1] = 0;
  arm.nominal.n = 1;
  arm.joints = {arm.joints[1]};
  return arm;
}

Log recorded(const ArmModel& arm, double duration_s, double frequency_hz, const fs::path& file) {
  Scenario scenario;
  scenario.robot = arm;
  scenario.duration_s = duration_s;
  scenario.fade_in_s = 1;
  JointTrajectory path;
  path.kind = JointTrajectory::Kind::sines;
  path.center = arm.joints[0].home;
  path.sines = {{0.25, frequency_hz, 0}, {0.12, 2.7 * frequency_hz, 1}};
  scenario.trajectory = {path};
  write_log(file, simulate(scenario).measured);
  return read_log_of(arm, file);
}

/// A log of an elbow with a backlash that its model does not have.
void diagnose_backlash(const fs::path& raven2, const fs::path& out) {
  const ArmModel nominal = elbow(raven2);
  ArmModel real = nominal;
  real.effects.push_back(place_effect(*find_effect("backlash"), real.nominal, 0));
  real.effects[0].p[0] = 0.35e-3;
  const std::vector<Log> training = {recorded(real, 8, 0.4, out / "training.csv")};
  const Log holdout = recorded(real, 4, 0.55, out / "holdout.csv");
  const Diagnosis d = diagnose(nominal, training, holdout, {.most_effects = 1, .tell_not_excited = false});
  const DiagnosisEvaluation evaluation = evaluate_diagnosis(nominal, d, training, holdout);
  expect(d.effects.size() == 1 && d.effects[0].effect.effect->name() == "backlash", "backlash, and nothing else");
  const Estimated& gap = d.effects[0].parameters.at(0);
  std::printf("backlash of %.3g m (%.3g to %.3g), true 0.00035: %s\n", gap.value, gap.lower, gap.upper,
              evaluation.why.at(0).c_str());
  // A tenth is many times the interval.
  expect(std::abs(gap.value / real.effects[0].p[0] - 1) < 0.1, "its size");
  expect(d.after.joint_rms[0] < 0.1 * d.before.joint_rms[0], "a tenth of the error on the hold-out");
  expect(evaluation.estimators.size() == 3, "three estimators on the hold-out");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    const fs::path raven2 = argv[2], out = argv[3];
    fs::remove_all(out);
    fs::create_directories(out);
    std::printf("halyard %s\n", kVersion);
    compare_plugins(argv[1], raven2);
    sweep_stiffness(raven2, out);
    diagnose_backlash(raven2, out);
    return 0;
  } catch (const std::exception& error) {
    std::printf("%s\n", error.what());
    return 1;
  }
}

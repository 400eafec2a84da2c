#include "app/tour/experiments_command.h"

#include <fmt/core.h>

#include "app/bundled_files.h"
#include "app/output_check.h"
#include "app/pages/comparison_figures.h"
#include "app/progress.h"
#include "app/terminal/terminal.h"
#include "app/tour/experiments_report.h"
#include "model/input_error.h"

namespace halyard {
namespace {

void print_summary(const std::vector<Experiment>& experiments) {
  const Comparison& first = experiments.front().comparison;
  print_out(
      "mean absolute error (the paper's Eq. 18), mean of experiments A, B, C, and improvement over kinematics:\n");
  for (std::size_t i = 0; i < first.runs.size(); ++i) {
    double microseconds = 0;
    for (const Experiment& e : experiments) microseconds += e.comparison.runs[i].microseconds_per_step;
    print_out("  {:<22}", first.runs[i].name);
    for (int k = 0; k < first.n_joints(); ++k) {
      print_out("  {:>9} {}", shown_number(mean_error(experiments, i, k), first.units[k]), first.units[k].shown);
      print_out(" {:>7}", i == first.baseline() ? "" : shown_percent(mean_gain(experiments, i, k)));
    }
    print_out("  {:.3g} us a step\n", microseconds / double(experiments.size()));
  }
  print_out("{}\n{}\n", order_of_gains(experiments), peaks_of_joint_one(experiments));
}

void print_study(const EffectStudy& study, const std::vector<JointUnit>& units) {
  print_out("mean absolute error with the robot's effects switched on and off (joints 1, 2, 3):\n  {:<28}", "");
  for (const std::string& name : study.estimators) print_out("  {:<30}", name);
  print_out("\n");
  for (const StudiedRobot& robot : study.robots) {
    print_out("  {:<28}", robot.name());
    for (const auto& errors : robot.error)
      for (std::size_t k = 0; k < units.size(); ++k) print_out("  {:>9}", shown_number(errors[k], units[k]));
    print_out("\n");
  }
}

}  // namespace

void run_experiments(const ExperimentsOptions& options) {
  const auto lock = lock_output_folder(options.out);
  const ExperimentsSetup setup{.raven2 = examples_folder(options.examples, "experiments") / "raven2",
                               .calibrated = options.calibrated,
                               .duration_s = options.duration_s};
  if (const double skipped = CompareOptions{}.skip_s; setup.duration_s > 0 && setup.duration_s <= skipped)
    throw InputError(
        fmt::format("halyard experiments: --duration {:g}: expected more than {:g} s, in which no errors "
                    "are counted; give a longer one",
                    setup.duration_s, skipped));
  std::vector<Experiment> experiments;
  std::optional<EffectStudy> study;
  {
    StageProgress progress("experiments");
    experiments = compute_experiments(setup, [&](double done) { progress.set("A, B, C", done); });
    if (options.effect_study)
      study = study_experiments(setup, [&](double done) { progress.set("effects one by one", done); });
  }
  OutputFiles files;
  write_experiments(files, options.out, experiments, study);
  commit_outputs(files);
  print_summary(experiments);
  if (study) print_study(*study, experiments.front().comparison.units);
  print_out("report: {}\n", (options.out / "report.html").string());
}

}  // namespace halyard

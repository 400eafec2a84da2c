#include "app/experiments_command.h"

#include <fmt/core.h>

#include "app/bundled_files.h"
#include "app/comparison_figures.h"
#include "app/experiments.h"
#include "app/output_check.h"
#include "app/progress.h"

namespace halyard {
namespace {

void print_summary(const std::vector<Experiment>& experiments) {
  const Comparison& first = experiments.front().comparison;
  fmt::print("mean absolute error (the paper's Eq. 18), mean of experiments A, B, C:\n");
  for (std::size_t i = 0; i < first.runs.size(); ++i) {
    double microseconds = 0;
    for (const Experiment& e : experiments) microseconds += e.comparison.runs[i].microseconds_per_step;
    fmt::print("  {:<10}", first.runs[i].name);
    for (int k = 0; k < first.n_joints(); ++k) {
      fmt::print("  {:>9} {}", shown_number(mean_error(experiments, i, k), first.units[k]), first.units[k].shown);
    }
    fmt::print("  {:.3g} us a step\n", microseconds / double(experiments.size()));
  }
}

}  // namespace

void run_experiments(const ExperimentsOptions& options) {
  check_output_folder(options.out);
  std::vector<Experiment> experiments;
  {
    StageProgress progress("experiments");
    experiments = compute_experiments(examples_folder(options.examples, "experiments") / "raven2",
                                      [&](const std::string& stage, double done) { progress.set(stage, done); });
  }
  write_experiments(options.out, experiments);
  print_summary(experiments);
  fmt::print("report: {}\n", (options.out / "report.html").string());
}

}  // namespace halyard

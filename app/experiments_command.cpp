#include "app/experiments_command.h"

#include <fmt/core.h>

#include "app/comparison_figures.h"
#include "app/experiments.h"
#include "app/output_check.h"
#include "model/input_error.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

/// The folder raven2 of the examples: as given, of the installation, or of the source tree.
fs::path raven2_folder(const fs::path& given) {
  if (!given.empty()) return given / "raven2";
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& examples : {program / HALYARD_EXAMPLES_FROM_PROGRAM, fs::path(HALYARD_EXAMPLES_IN_SOURCE)}) {
    if (fs::exists(examples / "raven2" / "raven2.xml", error)) return examples / "raven2";
  }
  throw InputError(
      "halyard experiments: the examples of this program are not found; give their folder with --examples DIR");
}

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
  const std::vector<Experiment> experiments = compute_experiments(raven2_folder(options.examples));
  write_experiments(options.out, experiments);
  print_summary(experiments);
  fmt::print("report: {}\n", (options.out / "report.html").string());
}

}  // namespace halyard

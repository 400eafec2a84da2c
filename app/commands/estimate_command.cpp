#include "app/commands/estimate_command.h"

#include <fmt/core.h>

#include <algorithm>

#include "app/log_input.h"
#include "app/output_check.h"
#include "app/progress.h"
#include "app/terminal/terminal.h"
#include "evaluation/comparison/compare.h"
#include "evaluation/run/estimate.h"
#include "model/arm_log.h"
#include "model/model_file.h"
#include "model/output/read_files.h"
#include "plugins/host/loader.h"

namespace halyard {
namespace {

void print_run_errors(const Comparison& comparison) {
  for (int k = 0; k < comparison.n_joints(); ++k) {
    if (!comparison.has_truth(k)) continue;
    const ErrorStatistics& error = comparison.errors[0][k];
    if (error.samples == 0) {
      print_out("joint {} position error after {:g} s: no samples\n", k + 1, comparison.skip_s);
      continue;
    }
    const JointUnit& unit = comparison.units[k];
    const auto shown = [&](double value) { return unit.shown_per_si * value; };
    print_out(
        "joint {} position error after {:g} s: RMS {:.6g} {} ({:.6g} {}), mean absolute {:.4g} {}, peak {:.4g} {}\n",
        k + 1, comparison.skip_s, error.rms, unit.si, shown(error.rms), unit.shown, shown(error.mean_absolute),
        unit.shown, shown(error.peak), unit.shown);
  }
}

}  // namespace

void run_estimate(const EstimateCommandOptions& options) {
  const auto lock = lock_output_file(options.out);
  const ArmModel model = read_model(options.model);
  const Log log = read_timed_log(model, options.data, options.columns, need_torque({options.estimator}));
  if (is_module_path(options.estimator)) note_read(options.estimator);  // it is opened later
  check_not_input(options.out);
  if (options.use_joint_torque) check_has_load(log);
  // The estimates are worth having even of a log that is too short for errors.
  if (options.skip_s != CompareOptions{}.skip_s) check_skip(options.skip_s, log.duration(), options.data.string());
  Comparison comparison;
  {
    Progress progress("estimate", log.duration(), "s");
    comparison = blaming_wrong_logs({log}, model, options.columns, [&] {
      return compare_estimators(model, {options.estimator}, log, log,
                                {.skip_s = options.skip_s,
                                 .use_joint_torque = options.use_joint_torque,
                                 .truth_is_sensed = true,
                                 .progress = [&](double fraction) { progress.set(fraction * log.duration()); }});
    });
  }
  const EstimatorRun& run = comparison.runs[0];
  write_estimates(options.out, run,
                  fmt::format("halyard estimate, estimator {}, model {}", options.estimator, options.model.string()));

  if (const std::string note = ignored_columns_note(log); !note.empty()) print_out("{}\n", note);
  if (std::ranges::all_of(log.joint_position, [](const auto& column) { return column.empty(); }))
    print_out("note: {}: has no joint sensors, so no error can be computed\n", options.data.string());
  for (const std::string& error : gross_errors(log, model, options.columns)) print_out("warning: {}\n", error);
  print_out("{}: {} samples, {:g} s, {:.3g} us a step\n", options.estimator, log.size(), log.duration(),
            run.microseconds_per_step);
  if (run.report.gated > 0 || run.report.repaired_factors > 0) {
    print_out("{} measurements not accepted, {} factors repaired\n", run.report.gated, run.report.repaired_factors);
  }
  print_run_errors(comparison);
  print_out("estimates: {}\n", options.out.string());
}

}  // namespace halyard

#include "app/commands/compare_command.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/log_input.h"
#include "app/output_check.h"
#include "app/pages/comparison_figures.h"
#include "app/pages/comparison_output.h"
#include "app/pages/judgement_tables.h"
#include "app/progress.h"
#include "app/terminal/terminal.h"
#include "evaluation/comparison/assumed_noise.h"
#include "model/arm_log.h"
#include "model/input_error.h"
#include "model/model_file.h"
#include "model/output/number_text.h"
#include "plant/scenario.h"
#include "plant/simulate.h"

namespace halyard {
namespace {

/// What the estimators get and what they are judged by.
struct Data {
  ArmModel model;
  std::string model_path;
  Log measured, truth;
  std::string truth_from;
  bool truth_is_sensed = false;  ///< by joint sensors, with their errors
  std::optional<Scenario> scenario;
};

Data simulated_data(const CompareCommandOptions& options) {
  if (!options.columns.empty()) {
    throw InputError("halyard compare: --column is for logs, and " + in_quotes(options.data.string()) +
                     " is a scenario; leave it out");
  }
  if (options.use_joint_torque) {
    throw InputError("halyard compare: --use-joint-torque is for logs, and " + in_quotes(options.data.string()) +
                     " is a scenario, which has no measured load; leave it out");
  }
  Scenario scenario = read_scenario(options.data, options.robot);
  check_skip(options.skip_s, scenario.duration_s, options.data.string());
  Data data;
  const std::filesystem::path model = options.model.empty() ? scenario.model : options.model;
  data.model = read_model(model);
  data.model_path = model.string();
  if (!joints_alike(data.model.nominal, scenario.robot.nominal))
    throw InputError(model.string() +
                     ": its joints are not those of the scenario's robot; give a model with as many "
                     "joints, of the same types and driven alike");
  if (options.noise) {
    scenario.noise = assumed_noise(data.model, scenario.control_period_s, *options.noise);
    scenario.quantise = false;
    // The assumed noise of a motor's reading contains that of its encoder, and no estimator reads joint sensors.
    for (JointParameters<double>& j : scenario.robot.nominal.joint) j.motor_encoder_noise = j.joint_encoder_noise = 0;
  }
  Progress progress("simulate", scenario.duration_s, "s");
  SimulationResult result =
      simulate_homed(scenario, data.model, [&](double f) { progress.set(f * scenario.duration_s); });
  data.measured = std::move(result.measured);
  data.measured.source = options.data.string();
  data.truth = std::move(result.truth);
  data.truth_from = "truth of the simulation";
  data.scenario = std::move(scenario);
  return data;
}

Data logged_data(const CompareCommandOptions& options) {
  if (options.model.empty()) {
    throw InputError("halyard compare: --model is missing; a log needs the model file of its robot, --model M.xml");
  }
  if (options.runs > 1 || options.noise || !options.robot.empty()) {
    throw InputError("halyard compare: --robot, --runs and --noise are for scenarios, and " +
                     in_quotes(options.data.string()) + " is a log; leave them out");
  }
  Data data;
  data.model = read_model(options.model);
  data.model_path = options.model.string();
  data.measured = read_timed_log(data.model, options.data, options.columns, need_torque(options.estimators));
  if (options.use_joint_torque) check_has_load(data.measured);
  check_skip(options.skip_s, data.measured.duration(), options.data.string());
  data.truth = data.measured;
  data.truth_is_sensed = true;
  const auto& sensors = data.truth.joint_position;
  if (std::ranges::any_of(sensors, [](const auto& column) { return !column.empty(); }))
    data.truth_from = "joint sensors";
  return data;
}

/// Failures that an error of the log explains become refusals that name it.
void blame_wrong_log(Comparison& comparison, const Data& data, const std::vector<std::string>& columns) {
  for (EstimatorRun& run : comparison.runs) {
    if (run.failure.empty() || run.refused) continue;
    const auto why = explained_by_log(run.failure, {data.measured}, data.model, columns);
    if (!why) return;
    run.failure = *why;
    run.refused = true;
  }
}

void print_notes(const Data& data, const std::vector<std::string>& wrong_columns) {
  if (const std::string note = ignored_columns_note(data.measured); !note.empty()) print_out("{}\n", note);
  if (data.truth_from.empty())
    print_out("note: {}: has no joint sensors, so no error can be computed\n", data.measured.source);
  for (const std::string& error : wrong_columns) print_out("warning: {}\n", error);
}

void print_errors(const Comparison& comparison) {
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    const EstimatorRun& run = comparison.runs[i];
    if (!run.failure.empty()) {
      print_out("{}: {}\n", run.name, run.refused ? "refused the data" : "failed");
      tell(run.failure);
      continue;
    }
    print_out("{} ({:.3g} us a step)\n", run.name, run.microseconds_per_step);
    for (int k = 0; k < comparison.n_joints(); ++k) {
      if (!comparison.has_truth(k)) continue;
      const ErrorStatistics& error = comparison.errors[i][k];
      if (error.samples == 0) {
        print_out("  joint {}: no samples after {:g} s\n", k + 1, comparison.skip_s);
        continue;
      }
      const JointUnit& unit = comparison.units[k];
      print_out("  joint {}: mean absolute error {} {}, RMS {} {}, peak {} {}", k + 1,
                shown_number(error.mean_absolute, unit), unit.shown, shown_number(error.rms, unit), unit.shown,
                shown_number(error.peak, unit), unit.shown);
      if (const auto baseline = comparison.baseline(); baseline && i != *baseline) {
        const double improvement = comparison.improvement_of(i, k);
        if (std::isfinite(improvement))  // else kinematics has failed
          print_out(", {} {} than kinematics, RMS ratio to kinematics {}", shown_percent(std::abs(improvement)),
                    improvement < 0 ? "worse" : "better", in_words(comparison.paired[i][*baseline][k]));
      }
      print_out("\n");
    }
  }
}

void print_runs(const MonteCarlo& runs, const std::vector<JointUnit>& units) {
  print_out("{} runs\n", runs.runs);
  for (const RunsOfEstimator& e : runs.estimators) {
    print_out("{}: {} failed\n", e.name, e.failures);
    for (std::size_t k = 0; k < units.size(); ++k)
      print_out("  joint {}: RMS {} {}, NEES {}, {} of the instants in its band, {}\n", k + 1,
                shown_number(e.errors[k].rms, units[k]), units[k].shown,
                std::isnan(e.nees[k].mean) ? "-" : with_digits(e.nees[k].mean, 4), shown_percent(e.in_band[k]),
                in_words(e.nees[k]));
  }
}

}  // namespace

void run_compare(const CompareCommandOptions& options) {
  const auto lock = lock_output_folder(options.out);
  const Data data = options.data.extension() == ".xml" ? simulated_data(options) : logged_data(options);
  Comparison comparison;
  {
    const double work_s = data.measured.duration() * double(options.estimators.size());
    Progress progress("estimate", work_s, "s");
    comparison = compare_estimators(data.model, options.estimators, data.measured, data.truth,
                                    {.skip_s = options.skip_s,
                                     .use_joint_torque = options.use_joint_torque,
                                     .truth_is_sensed = data.truth_is_sensed,
                                     .keep_going = true,
                                     .containment = {.step_limit_s = options.step_limit_s},
                                     .progress = [&](double fraction) { progress.set(fraction * work_s); }});
  }
  if (!data.scenario) blame_wrong_log(comparison, data, options.columns);
  if (std::ranges::none_of(comparison.runs, &std::string::empty, &EstimatorRun::failure)) {
    const EstimatorRun& first = comparison.runs[0];
    if (first.refused) throw InputError(first.failure);
    throw std::runtime_error(first.failure);
  }
  comparison.data = options.data.string();
  comparison.model = data.model_path;
  comparison.truth_from = data.truth_from;
  if (!data.scenario) comparison.wrong_columns = gross_errors(data.measured, data.model, options.columns);
  std::optional<MonteCarlo> runs;
  if (options.runs > 1) {
    Progress progress("runs", options.runs, "runs");
    runs = run_monte_carlo(*data.scenario, data.model, options.estimators,
                           {.runs = options.runs,
                            .skip_s = options.skip_s,
                            .containment = {.step_limit_s = options.step_limit_s},
                            .run_done = [&](double amount) { progress.add(amount); }});
    runs->noise = options.noise;
  }
  OutputFiles files;
  write_comparison(files, options.out, comparison, runs);
  commit_outputs(files);
  if (!data.scenario) print_notes(data, comparison.wrong_columns);
  print_errors(comparison);
  if (runs) print_runs(*runs, comparison.units);
  print_out("report: {}\n", (options.out / "report.html").string());
}

}  // namespace halyard

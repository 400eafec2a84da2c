#include "app/tour/tour_command.h"

#include <fmt/core.h>

#include <cmath>

#include "app/bundled_files.h"
#include "app/output_check.h"
#include "app/pages/comparison_figures.h"
#include "app/pages/diagnosis/diagnosis_output.h"
#include "app/progress.h"
#include "app/terminal/terminal.h"
#include "app/tour/tour.h"
#include "diagnosis/explanation/view_sentence.h"
#include "model/input_error.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

fs::path recordings_folder(const fs::path& given) {
  if (given.empty()) return default_recordings_folder();
  std::error_code error;
  if (fs::is_directory(given, error)) return given;
  throw InputError("halyard tour: --recordings " + in_quotes(given.string()) +
                   ": is no folder; give one with a folder for each rig");
}

void print_experiments(const std::vector<Experiment>& experiments) {
  const Comparison& first = experiments.front().comparison;
  print_out("Mean absolute error of the joint position, mean of the paper's experiments A, B, C:\n");
  const auto print_row = [](const char* where, const std::string& what, const auto& error_of) {
    print_out("  {:<9}  {:<27}", where, what);
    for (int k = 0; k < 3; ++k) print_out("  {:>9}", error_of(k));
    print_out("\n");
  };
  print_row("", "", [&](int k) { return fmt::format("q{} [{}]", k + 1, first.units[k].shown); });
  for (std::size_t i = 0; i < first.runs.size(); ++i) {
    print_row("simulated", first.runs[i].name,
              [&](int k) { return shown_number(mean_error(experiments, i, k), first.units[k]); });
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const PublishedErrors& published = published_errors()[i];
    print_row("robot", published.source, [&](int k) { return fmt::format("{:.4g}", published.error[k]); });
  }
}

void print_errors(const DiagnosedModel& diagnosed) {
  const std::vector<JointUnit> units = joint_units(diagnosed.model);
  const Diagnosis& d = diagnosed.diagnosis;
  for (int k = 0; k < diagnosed.model.n(); ++k) {
    print_out("    joint {}:", k + 1);
    if (std::isfinite(d.before.joint_rms[k])) {
      print_out(" position RMS {} -> {} {}", shown_number(d.before.joint_rms[k], units[k]),
                shown_number(d.after.joint_rms[k], units[k]), units[k].shown);
    }
    if (std::isfinite(d.before.torque_rms[k])) {
      const ShownUnit unit = residual_unit(diagnosed.model.nominal, k, ResidualKind::motor_torque);
      print_out("{} {} RMS {:.4g} -> {:.4g} {}", std::isfinite(d.before.joint_rms[k]) ? "," : "",
                residual_name(diagnosed.model.nominal, k, ResidualKind::motor_torque),
                unit.per_si * d.before.torque_rms[k], unit.per_si * d.after.torque_rms[k], unit.name);
    }
    print_out("\n");
  }
}

void print_bundled(const Tour& tour) {
  print_out("\nDiagnosis of the bundled log undeclared_effect.csv: {}\n", verdict_line(tour.bundled.diagnosis));
  for (const FoundParameter& p : found_parameters(tour)) {
    print_out("    {} {}: {:.4g} {} in the log's robot, ", p.effect, p.name, p.value, p.unit);
    if (p.found == nullptr) {
      print_out("not found\n");
    } else {
      print_out("found {:.4g} (95 %: {:.4g} to {:.4g})\n", p.found->value, p.found->lower, p.found->upper);
    }
  }
  print_errors(tour.bundled);
}

void print_rigs(const Tour& tour) {
  print_out(
      "\nRecordings of real rigs, at most one effect each (halyard diagnose looks for more), errors on the "
      "hold-out:\n");
  for (const RigResult& result : tour.rigs) {
    if (result.diagnosed) {
      print_out("  {}: {}\n", result.rig.title, verdict_line(result.diagnosed->diagnosis));
      print_errors(*result.diagnosed);
    } else {
      print_out("  {}: not at hand; examples/measured/{}/README.md says where to get it\n", result.rig.title,
                result.rig.folder);
    }
  }
}

}  // namespace

void run_tour(const TourOptions& options) {
  const auto lock = lock_output_folder(options.out);
  const fs::path examples = examples_folder(options.examples, "tour");
  const fs::path recordings = recordings_folder(options.recordings);
  Tour tour;
  {
    StageProgress progress("tour");
    tour = compute_tour(examples, recordings,
                        [&](const std::string& what, double fraction) { progress.set(what, fraction); });
  }
  OutputFiles files;
  write_tour(files, options.out, tour);
  commit_outputs(files);
  print_experiments(tour.experiments);
  print_bundled(tour);
  print_rigs(tour);
  print_out("\nreport: {}\n", (options.out / "report.html").string());
}

}  // namespace halyard

#include "app/comparison_output.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/comparison_figures.h"
#include "app/report/page.h"
#include "model/output_file.h"

namespace halyard {
namespace {

using nlohmann::ordered_json;

ordered_json run_json(const Comparison& comparison, std::size_t i) {
  const EstimatorRun& run = comparison.runs[i];
  ordered_json joints = ordered_json::array();
  for (int k = 0; k < comparison.n_joints(); ++k) {
    const ErrorStatistics& error = comparison.errors[i][k];
    joints.push_back({{"joint", k + 1},
                      {"unit", comparison.units[k].si},
                      {"samples", error.samples},
                      {"mean_absolute_error", number_or_null(error.mean_absolute)},
                      {"rms_error", number_or_null(error.rms)},
                      {"peak_error", number_or_null(error.peak)},
                      {"bias", number_or_null(error.bias)},
                      {"improvement_over_kinematics", number_or_null(comparison.improvement_of(i, k))},
                      {"within_two_std", number_or_null(error.within_two_std)}});
  }
  return {{"estimator", run.name},
          {"steps", run.report.steps},
          {"gated_measurements", run.report.gated},
          {"repaired_factors", run.report.repaired_factors},
          {"mean_nis", number_or_null(run.mean_nis)},
          {"joints", joints}};
}

report::Page comparison_page(const Comparison& comparison) {
  const std::size_t samples = comparison.truth.size();
  report::Page page("Estimators compared", fmt::format("{} with {}: {} samples, {:.6g} s", comparison.data,
                                                       comparison.model, samples, comparison.truth.duration()));
  if (comparison.truth_from.empty()) {
    page.verdict(report::VerdictKind::warning,
                 "The record has no joint sensors: the estimates are shown, but there is nothing to judge them by.");
  } else {
    page.paragraph(fmt::format(
        "Every estimator was given the same motor torques and motor positions and nothing else of the joints. Errors "
        "are estimate minus {}, from {:g} s after the first sample on. The mean absolute error is the paper's Eq. 18, "
        "which it calls RMS.",
        comparison.truth_from, comparison.skip_s));
    page.table(error_table(comparison));
    page.paragraph(
        "Improvement is 1 - mean absolute error / that of the kinematics estimator. Within 2 sigma: the share of "
        "errors of at most two of the estimator's own standard deviations. About 95 % is right; less says that the "
        "estimator trusts its model too much, more that it is better than it says.");
  }
  add_joint_figures(page, comparison);
  return page;
}

}  // namespace

std::string json_text(const ordered_json& json) {
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

ordered_json number_or_null(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr); }

ordered_json to_json(const Comparison& comparison) {
  ordered_json estimators = ordered_json::array();
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) estimators.push_back(run_json(comparison, i));
  ordered_json truth = nullptr;
  if (!comparison.truth_from.empty()) truth = comparison.truth_from;
  return {{"data", comparison.data},
          {"model", comparison.model},
          {"truth", truth},
          {"samples", comparison.truth.size()},
          {"duration_s", comparison.truth.duration()},
          {"errors_counted_after_s", comparison.skip_s},
          {"estimators", estimators}};
}

std::vector<std::string> error_columns() {
  return {"joint",         "unit",       "samples", "mean_absolute_error",
          "rms_error",     "peak_error", "bias",    "improvement_over_kinematics",
          "within_two_std"};
}

void add_error_cells(CsvTable& table, const Comparison& comparison, std::size_t run, int k) {
  const ErrorStatistics& error = comparison.errors[run][k];
  table.add(std::to_string(k + 1));
  table.add(comparison.units[k].si);
  table.add(std::to_string(error.samples));
  for (const double value : {error.mean_absolute, error.rms, error.peak, error.bias, comparison.improvement_of(run, k),
                             error.within_two_std}) {
    table.add(value);
  }
}

void write_comparison(const std::filesystem::path& folder, const Comparison& comparison) {
  std::vector<std::string> header = error_columns();
  header.insert(header.begin(), "estimator");
  CsvTable table(header);
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    for (int k = 0; k < comparison.n_joints(); ++k) {
      table.add(comparison.runs[i].name);
      add_error_cells(table, comparison, i, k);
    }
  }
  const report::Page page = comparison_page(comparison);
  const std::string json = json_text(to_json(comparison));
  table.write(folder / "comparison.csv");
  write_file_whole(folder / "comparison.json", json);
  page.write(folder / "report.html");
}

}  // namespace halyard

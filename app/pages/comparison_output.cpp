#include "app/pages/comparison_output.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "app/pages/comparison_figures.h"
#include "app/pages/judgement_tables.h"
#include "app/report/page.h"
#include "evaluation/json.h"

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
                      {"median_absolute_error", number_or_null(error.median_absolute)},
                      {"percentile_95_error", number_or_null(error.percentile_95)},
                      {"peak_error", number_or_null(error.peak)},
                      {"bias", number_or_null(error.bias)},
                      {"improvement_over_kinematics", number_or_null(comparison.improvement_of(i, k))},
                      {"within_two_std", number_or_null(error.within_two_std)},
                      {"nees", to_json(comparison.judgements[i].nees[k])}});
  }
  return {{"estimator", run.name},
          {"failure", text_or_null(run.failure)},
          {"steps", run.report.steps},
          {"gated_measurements", run.report.gated},
          {"repaired_factors", run.report.repaired_factors},
          {"mean_nis", number_or_null(mean_of(run.nis))},
          {"nis", to_json(comparison.judgements[i].nis)},
          {"joints", joints}};
}

ordered_json paired_json(const Comparison& comparison) {
  ordered_json all = ordered_json::array();
  for (std::size_t a = 0; a < comparison.runs.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (int k = 0; k < comparison.n_joints(); ++k) {
        if (!comparison.has_truth(k)) continue;
        ordered_json pair = {
            {"estimator", comparison.runs[a].name}, {"against", comparison.runs[b].name}, {"joint", k + 1}};
        pair.update(to_json(comparison.paired[a][b][k]));
        all.push_back(pair);
      }
  return all;
}

std::string further_inputs(const Comparison& comparison) {
  return std::string(comparison.with_joint_torque ? ", the measured loads on the joints" : "") +
         (comparison.with_marker ? ", the positions of the camera's marker" : "");
}

report::Page comparison_page(const Comparison& comparison, const std::optional<MonteCarlo>& runs) {
  const std::size_t samples = comparison.truth.size();
  report::Page page("Estimators compared", fmt::format("{} with {}: {} samples, {:.6g} s", comparison.data,
                                                       comparison.model, samples, comparison.truth.duration()));
  for (const EstimatorRun& run : comparison.runs)
    if (!run.failure.empty()) page.verdict(report::VerdictKind::warning, "Failed: " + run.failure);
  if (!comparison.wrong_columns.empty())
    page.verdict(report::VerdictKind::bad,
                 "The log is wrong, so this comparison means nothing:", comparison.wrong_columns);
  if (comparison.truth_from.empty()) {
    page.verdict(report::VerdictKind::warning,
                 "The record has no joint sensors: the estimates are shown, but there is nothing to judge them by.");
  } else {
    page.paragraph(fmt::format(
        "Every estimator was given the same motor torques and motor positions{}, and nothing else of the joints. "
        "Errors "
        "are estimate minus {}, from {:g} s after the first sample on. The mean absolute error is the paper's Eq. 18, "
        "which it calls RMS.",
        further_inputs(comparison), comparison.truth_from, comparison.skip_s));
    page.table(error_table(comparison));
    page.paragraph(
        "Improvement is 1 - mean absolute error / that of the kinematics estimator. Within 2 sigma is the share of the "
        "errors that are at most two standard deviations, as the estimator states them. It should be about 95 %. If it "
        "is smaller, the errors are larger than the estimator states; if it is larger, they are smaller.");
  }
  if (!comparison.truth_from.empty() && comparison.runs.size() > 1) {
    page.table(paired_table(comparison));
    page.paragraph(
        "Successive errors are correlated, so the record is divided into four or more blocks, each as long as six "
        "independent errors if the record has so many. The interval comes from how much the ratio changes when one "
        "block after the other is left out. An estimator is called better or worse if the 95 % interval does not "
        "contain 1.");
  }
  page.table(consistency_table(comparison));
  page.paragraph(
      "An innovation is a measurement minus its prediction, divided by the standard deviation that the filter states "
      "for it. An error of a joint is divided by its stated standard deviation, too. The mean squares of both should "
      "be 1. The band contains 95 % of such means if the stated deviations are right; correlated samples count as "
      "one. White innovations contain nothing that could have been predicted.");
  if (runs) {
    page.table(runs_error_table(*runs, comparison.units));
    page.table(runs_consistency_table(*runs));
    page.paragraph(
        fmt::format("Instants in band: at how many of the record's instants the mean NEES over the runs lies in the "
                    "band of {} independent squares; 95 % is right. All other tables, and the figures below, are "
                    "those of the first seed.",
                    runs->runs));
  }
  add_joint_figures(page, comparison);
  return page;
}

}  // namespace

ordered_json to_json(const Comparison& comparison) {
  ordered_json estimators = ordered_json::array();
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) estimators.push_back(run_json(comparison, i));
  ordered_json truth = nullptr;
  if (!comparison.truth_from.empty()) truth = comparison.truth_from;
  return {{"data", comparison.data},
          {"model", comparison.model},
          {"truth", truth},
          {"wrong_columns", comparison.wrong_columns},
          {"samples", comparison.truth.size()},
          {"duration_s", comparison.truth.duration()},
          {"errors_counted_after_s", comparison.skip_s},
          {"with_joint_torque", comparison.with_joint_torque},
          {"with_marker", comparison.with_marker},
          {"estimators", estimators},
          {"paired", paired_json(comparison)}};
}

std::vector<std::string> error_columns() {
  return {"joint",
          "unit",
          "samples",
          "mean_absolute_error",
          "rms_error",
          "peak_error",
          "bias",
          "improvement_over_kinematics",
          "within_two_std",
          "median_absolute_error",
          "percentile_95_error"};
}

void add_error_cells(CsvTable& table, const Comparison& comparison, std::size_t run, int k) {
  const ErrorStatistics& error = comparison.errors[run][k];
  table.add(std::to_string(k + 1));
  table.add(comparison.units[k].si);
  table.add(std::to_string(error.samples));
  for (const double value : {error.mean_absolute, error.rms, error.peak, error.bias, comparison.improvement_of(run, k),
                             error.within_two_std, error.median_absolute, error.percentile_95}) {
    table.add(value);
  }
}

void write_comparison(OutputFiles& files, const std::filesystem::path& folder, const Comparison& comparison,
                      const std::optional<MonteCarlo>& runs) {
  std::vector<std::string> header = error_columns();
  header.insert(header.begin(), "estimator");
  CsvTable table(header);
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    for (int k = 0; k < comparison.n_joints(); ++k) {
      table.add(comparison.runs[i].name);
      add_error_cells(table, comparison, i, k);
    }
  }
  ordered_json all = to_json(comparison);
  if (runs) all["monte_carlo"] = to_json(*runs);
  files.add(folder / "comparison.csv", table.text());
  files.add(folder / "comparison.json", json_text(all));
  files.add(folder / "report.html", comparison_page(comparison, runs).html());
}

}  // namespace halyard

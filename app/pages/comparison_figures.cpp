#include "app/pages/comparison_figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace halyard {
namespace {

using report::Cell;
using report::Chart;
using report::ChartKind;
using report::Series;

/// Of the palette: black is the truth's own, so that an estimator has the same colour in every chart.
constexpr std::size_t kTruthColour = 6;

std::string joint_title(int k, const char* what) { return fmt::format("Joint {}: {}", k + 1, what); }

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> result(values);
  for (double& value : result) value *= factor;
  return result;
}

std::vector<double> shown_errors(const Comparison& comparison, std::size_t run, int k) {
  const std::vector<double>& estimate = comparison.compared[run][k];
  const std::vector<double>& truth = comparison.truth.joint_position[k];
  std::vector<double> errors(estimate.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    errors[i] = comparison.units[k].shown_per_si * (estimate[i] - truth[i]);
  }
  return errors;
}

/// Index of the run with the least mean absolute error of joint k; none where it is not known or there is one run only.
std::optional<std::size_t> best_run(const Comparison& comparison, int k) {
  if (comparison.runs.size() < 2) return std::nullopt;
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    const double error = comparison.errors[i][k].mean_absolute;
    if (!std::isnan(error) && (!best || error < comparison.errors[*best][k].mean_absolute)) best = i;
  }
  return best;
}

/// Whether the baseline's errors are so large that the others' are a line at zero beside them.
bool baseline_hides_others(const Comparison& comparison, int k) {
  const std::optional<std::size_t> baseline = comparison.baseline();
  if (!baseline) return false;
  double largest = 0;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i)
    if (i != *baseline) largest = std::fmax(largest, comparison.errors[i][k].peak);
  constexpr double kSeen = 0.1;  // share of a chart's height
  return largest > 0 && largest < kSeen * comparison.errors[*baseline][k].peak;
}

/// "", or " without kinematics".
std::string without(const Comparison& comparison, std::optional<std::size_t> left_out) {
  return left_out ? " without " + comparison.runs[*left_out].name : "";
}

}  // namespace

std::string shown_number(double si_value, const JointUnit& unit) {
  return std::isnan(si_value) ? "-" : fmt::format("{:.4g}", unit.shown_per_si * si_value);
}

std::string shown_percent(double fraction) {
  return std::isnan(fraction) ? "-" : fmt::format("{:.1f} %", 100 * fraction);
}

Chart trajectory_chart(const Comparison& comparison, int k) {
  const JointUnit& unit = comparison.units[k];
  Chart chart{.title = joint_title(k, "position"),
              .x_label = "time [s]",
              .y_label = fmt::format("joint position [{}]", unit.shown)};
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    const EstimatorRun& run = comparison.runs[i];
    chart.series.push_back(Series{.name = run.name,
                                  .x = run.estimates.time,
                                  .y = scaled(run.estimates.joint_position[k], unit.shown_per_si),
                                  .colour = i % kTruthColour});
  }
  if (comparison.has_truth(k)) {
    chart.series.push_back(Series{.name = comparison.truth_from,
                                  .x = comparison.truth.time,
                                  .y = scaled(comparison.truth.joint_position[k], unit.shown_per_si),
                                  .dashed = true,
                                  .colour = kTruthColour});
  }
  return chart;
}

Chart error_chart(const Comparison& comparison, int k, std::optional<std::size_t> left_out) {
  Chart chart{.title = joint_title(k, "error over time") + without(comparison, left_out),
              .x_label = "time [s]",
              .y_label = fmt::format("estimate - truth [{}]", comparison.units[k].shown)};
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    if (i == left_out) continue;
    chart.series.push_back(Series{.name = comparison.runs[i].name,
                                  .x = comparison.truth.time,
                                  .y = shown_errors(comparison, i, k),
                                  .colour = i % kTruthColour});
  }
  if (comparison.skip_s > 0 && !comparison.truth.time.empty()) {
    const double start = comparison.truth.time.front();
    chart.regions.push_back({start, start + comparison.skip_s, "not counted"});
  }
  return chart;
}

Chart error_histogram(const Comparison& comparison, int k, std::optional<std::size_t> left_out) {
  const std::size_t first = first_counted_sample(comparison.truth.time, comparison.skip_s);
  std::vector<report::Sample> samples;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    if (i == left_out) continue;
    std::vector<double> errors = shown_errors(comparison, i, k);
    errors.erase(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(first));
    samples.push_back({comparison.runs[i].name, std::move(errors)});
  }
  constexpr std::size_t kBins = 60;
  Chart chart = report::histogram(joint_title(k, "errors") + without(comparison, left_out),
                                  fmt::format("estimate - truth [{}]", comparison.units[k].shown), samples, kBins);
  for (std::size_t i = 0; i < chart.series.size(); ++i)
    chart.series[i].colour = (left_out && i >= *left_out ? i + 1 : i) % kTruthColour;
  return chart;
}

report::Table error_table(const Comparison& comparison) {
  report::Table table;
  table.caption = fmt::format("Error of the joint position after the first {:g} s", comparison.skip_s);
  table.header = {"joint",      "estimator", "unit", "mean absolute error",         "RMS",           "median",
                  "95 % below", "peak",      "bias", "improvement over kinematics", "within 2 sigma"};
  table.align = {report::Align::left, report::Align::left, report::Align::left};
  table.align.resize(table.header.size(), report::Align::right);
  for (int k = 0; k < comparison.n_joints(); ++k) {
    const JointUnit& unit = comparison.units[k];
    const std::optional<std::size_t> best = best_run(comparison, k);
    const auto reads_as = [&](std::size_t a, std::size_t b) {
      return shown_number(comparison.errors[a][k].mean_absolute, unit) ==
             shown_number(comparison.errors[b][k].mean_absolute, unit);
    };
    for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
      const ErrorStatistics& error = comparison.errors[i][k];
      const bool is_baseline = i == comparison.baseline();
      table.rows.push_back({Cell(std::to_string(k + 1)), Cell(comparison.runs[i].name), Cell(unit.shown),
                            Cell(shown_number(error.mean_absolute, unit), best && reads_as(i, *best)),
                            Cell(shown_number(error.rms, unit)), Cell(shown_number(error.median_absolute, unit)),
                            Cell(shown_number(error.percentile_95, unit)), Cell(shown_number(error.peak, unit)),
                            Cell(shown_number(error.bias, unit)),
                            Cell(is_baseline ? "-" : shown_percent(comparison.improvement_of(i, k))),
                            Cell(shown_percent(error.within_two_std))});
    }
  }
  return table;
}

void add_joint_figures(report::Page& page, const Comparison& comparison, const std::string& prefix) {
  for (int k = 0; k < comparison.n_joints(); ++k) {
    page.heading(fmt::format("{}Joint {}", prefix, k + 1));
    page.chart(trajectory_chart(comparison, k));
    if (!comparison.has_truth(k)) {
      page.paragraph("The record has no sensor at this joint: there is nothing to count errors against.");
      continue;
    }
    page.figure_row({error_chart(comparison, k), error_histogram(comparison, k)});
    if (const auto left_out = comparison.baseline(); baseline_hides_others(comparison, k))
      page.figure_row({error_chart(comparison, k, left_out), error_histogram(comparison, k, left_out)});
  }
}

}  // namespace halyard

#include "app/pages/sweep_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/pages/comparison_figures.h"
#include "app/report/page.h"
#include "evaluation/sweep/sweep_table.h"

namespace halyard {
namespace {

using report::Cell;
using report::Chart;
using report::Series;

/// A page with more curves or rows than this would not be read; sweep.csv has all.
constexpr std::size_t kMaxSlices = 12;
constexpr std::size_t kMaxRows = 300;

/// Whether values of these ends need a logarithmic axis to be read.
bool spans_decades(double least, double greatest, double decades) {
  return least > 0 && greatest >= least * std::pow(10, decades);
}

/// Whether the joint's errors span so much that only a logarithmic axis shows them all; the same for all its charts.
bool needs_log_y(const std::vector<SweepCell>& cells, std::size_t k) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const SweepCell& cell : cells) {
    for (const SweepCell::Result& result : cell.results) {
      const double error = result.errors[k].mean_absolute;
      if (std::isnan(error)) continue;
      least = std::min(least, error);
      greatest = std::max(greatest, error);
    }
  }
  return spans_decades(least, greatest, 2);
}

/// Mean absolute error of a joint over the first axis; slice counts the points of the other axes.
Chart curve(const SweepGrid& grid, const std::vector<SweepCell>& cells, std::size_t slice, std::size_t k) {
  const SweepAxis& axis = grid.axes.front();
  const JointUnit& unit = grid.units[k];
  const std::size_t stride = grid.size() / axis.values.size();
  Chart chart{.title = fmt::format("Joint {}", k + 1),
              .x_label = axis.unit.empty() ? axis.label() : fmt::format("{} [{}]", axis.label(), axis.unit),
              .y_label = fmt::format("mean absolute error [{}]", unit.shown)};
  for (std::size_t i = 0; i < grid.estimators.size(); ++i) {
    std::vector<std::pair<double, double>> points;
    for (std::size_t place = 0; place < axis.values.size(); ++place) {
      const double error = unit.shown_per_si * cells[place * stride + slice].results[i].errors[k].mean_absolute;
      points.emplace_back(axis.values[place], error);
    }
    std::ranges::sort(points, {}, &std::pair<double, double>::first);
    Series series{.name = grid.estimators[i]};
    for (const auto& [x, y] : points) {
      series.x.push_back(x);
      series.y.push_back(y);
    }
    chart.series.push_back(std::move(series));
  }
  const auto [lowest, highest] = std::ranges::minmax(axis.values);
  chart.log_x = lowest > 0 && (axis.is_logarithmic || spans_decades(lowest, highest, 1));
  chart.log_y = needs_log_y(cells, k);
  return chart;
}

report::Table error_rows(const SweepGrid& grid, const std::vector<SweepCell>& cells) {
  report::Table table;
  table.caption = fmt::format("Mean absolute error after the first {:g} s", grid.skip_s);
  for (const SweepAxis& axis : grid.axes) {
    table.header.push_back(axis.unit.empty() ? axis.label() : fmt::format("{} [{}]", axis.label(), axis.unit));
  }
  table.header.push_back("estimator");
  for (std::size_t k = 0; k < grid.units.size(); ++k) {
    table.header.push_back(fmt::format("joint {} [{}]", k + 1, grid.units[k].shown));
  }
  for (const SweepCell& cell : cells) {
    for (std::size_t i = 0; i < cell.results.size() && table.rows.size() < kMaxRows; ++i) {
      std::vector<Cell> row;
      for (const double value : grid.values(cell.point)) row.emplace_back(fmt::format("{:.6g}", value));
      row.emplace_back(grid.estimators[i]);
      for (std::size_t k = 0; k < grid.units.size(); ++k) {
        row.emplace_back(shown_number(cell.results[i].errors[k].mean_absolute, grid.units[k]));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

std::string axis_sentence(const SweepAxis& axis) {
  const char* where = axis.applies_to == SweepAxis::Target::robot   ? "in the robot alone, unknown to the estimators"
                      : axis.applies_to == SweepAxis::Target::model ? "in the estimators' model alone"
                                                                    : "in the robot and in the estimators' model";
  return fmt::format("{}, {} values{}, {}.", fmt::join(axis.parameters, ", "), axis.values.size(),
                     axis.is_factor ? ", each a factor of the number in the file" : "", where);
}

report::Page sweep_page(const SweepGrid& grid, const std::vector<SweepCell>& cells) {
  report::Page page("Sweep: " + grid.name, fmt::format("scenario {}, model {}, {} points, estimators {}", grid.scenario,
                                                       grid.model, grid.size(), fmt::join(grid.estimators, ", ")));
  page.paragraph(
      "At each point of the grid the plant is simulated anew, and each estimator gets its motor signals. The curves "
      "show the mean absolute error of the joint positions (the paper's Eq. 18) against the truth of the simulation.");
  for (const SweepAxis& axis : grid.axes) page.paragraph("Varied: " + axis_sentence(axis));
  const std::size_t failures = count_failures(cells);
  if (failures > 0) {
    page.verdict(report::VerdictKind::warning,
                 fmt::format("{} of {} runs of estimators failed and are gaps; sweep.csv says why.", failures,
                             cells.size() * grid.estimators.size()));
  }
  const std::size_t slices = grid.size() / grid.axes.front().values.size();
  for (std::size_t slice = 0; slice < std::min(slices, kMaxSlices); ++slice) {
    if (slices > 1) page.heading(grid.description(slice, 1));
    std::vector<Chart> charts;
    for (std::size_t k = 0; k < grid.units.size(); ++k) charts.push_back(curve(grid, cells, slice, k));
    page.figure_row(charts);
  }
  if (slices > kMaxSlices) {
    page.paragraph(
        fmt::format("Curves of {} of {} combinations of the other axes; sweep.csv has all.", kMaxSlices, slices));
  }
  page.heading("Numbers");
  page.table(error_rows(grid, cells));
  if (cells.size() * grid.estimators.size() > kMaxRows) {
    page.paragraph(fmt::format("The first {} rows; sweep.csv has all, with RMS, peak and bias.", kMaxRows));
  }
  return page;
}

}  // namespace

void write_sweep_report(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid,
                        const std::vector<SweepCell>& cells) {
  files.add(folder / "sweep.csv", sweep_csv(grid, cells));
  files.add(folder / "report.html", sweep_page(grid, cells).html());
}

}  // namespace halyard

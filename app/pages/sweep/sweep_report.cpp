#include "app/pages/sweep/sweep_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "app/pages/comparison_figures.h"
#include "app/pages/sweep/sweep_charts.h"
#include "app/pages/sweep/sweep_pictures.h"
#include "app/report/page.h"
#include "evaluation/sweep/sweep_table.h"

namespace halyard {
namespace {

using report::Cell;
using report::Chart;
using report::Series;

/// A page with more curves, longer ones, or more rows than this would not be read; sweep.csv has all.
constexpr std::size_t kMaxSlices = 12;
constexpr std::size_t kMaxPlaces = 200;
constexpr std::size_t kMaxRows = 300;

/// The m-th measure of a joint over the first axis; slice counts the points of the other axes.
Chart slice_chart(const SweepGrid& grid, const StoredCells& cells, const SweepSummary& summary, std::size_t slice,
                  std::size_t m, std::size_t k) {
  const SweepAxis& axis = grid.axes.front();
  const std::size_t stride = grid.combinations() / axis.values.size();
  Chart chart = empty_chart(grid, summary, axis, m, k);
  for (std::size_t i = 0; i < grid.estimators.size(); ++i) {
    std::map<double, MeanWithInterval> places;
    for (std::size_t place = 0; place < axis.values.size(); ++place)
      for (std::size_t seed = 0; seed < grid.n_seeds(); ++seed) {
        const SweepCell cell = cells.read((place * stride + slice) * grid.n_seeds() + seed);
        places[axis.values[place]].add(cell.shown(grid, m, i, k));
      }
    SweepSummary::Curve curve;
    for (const auto& [x, mean] : places) {
      curve.x.push_back(x);
      curve.means.push_back(mean);
    }
    const double shown_per_si = grid.measures[m]->shown_unit(grid.units[k]).shown_per_si;
    chart.series.push_back(series_of(grid.estimators[i], curve, shown_per_si));
  }
  return chart;
}

void add_slices(report::Page& page, const SweepGrid& grid, const StoredCells& cells, const SweepSummary& summary) {
  const std::size_t slices = grid.combinations() / grid.axes.front().values.size();
  for (std::size_t slice = 0; slice < slices; ++slice) {
    if (slices > 1) page.heading(grid.description(slice * grid.n_seeds(), 1));
    for (const std::size_t m : shown_measures(grid)) {
      std::vector<Chart> charts;
      for (std::size_t k = 0; k < n_charts(grid, m); ++k)
        charts.push_back(slice_chart(grid, cells, summary, slice, m, k));
      page.figure_row(charts);
    }
  }
}

/// For each axis the mean over everything else that varies.
void add_means(report::Page& page, const SweepGrid& grid, const SweepSummary& summary) {
  for (std::size_t a = 0; a < grid.axes.size(); ++a) {
    page.heading(fmt::format("Over {}, averaged over everything else that varies", grid.axes[a].label()));
    for (const std::size_t m : shown_measures(grid)) page.figure_row(mean_charts(grid, summary, m, a));
  }
}

/// The m-th measure at each point.
report::Table rows_of(const SweepGrid& grid, const StoredCells& cells, std::size_t m) {
  const SweepMeasure& measure = *grid.measures[m];
  report::Table table;
  table.caption = fmt::format("{}{} after the first {:g} s", char(std::toupper(measure.shown_as[0])),
                              measure.shown_as.substr(1), grid.skip_s);
  for (const SweepAxis& axis : grid.axes) table.header.push_back(axis_label(axis));
  if (!grid.seeds.empty()) table.header.push_back("seed");
  table.header.push_back("estimator");
  for (std::size_t k = 0; k < n_charts(grid, m); ++k) {
    const std::string& unit = measure.shown_unit(grid.units[k]).shown;
    table.header.push_back(lower_case(joint_title(grid, m, k)) + (unit.empty() ? "" : " [" + unit + "]"));
  }
  for (std::size_t point = 0; point < cells.size() && table.rows.size() < kMaxRows; ++point) {
    const SweepCell cell = cells.read(point);
    for (std::size_t i = 0; i < cell.results.size() && table.rows.size() < kMaxRows; ++i) {
      std::vector<Cell> row;
      for (const double value : grid.values(cell.point)) row.emplace_back(fmt::format("{:.6g}", value));
      if (const auto seed = grid.seed(point)) row.emplace_back(std::to_string(*seed));
      row.emplace_back(grid.estimators[i]);
      for (std::size_t k = 0; k < n_charts(grid, m); ++k)
        row.emplace_back(shown_number(cell.shown(grid, m, i, k), measure.shown_unit(grid.units[k])));
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

report::Page sweep_page(const SweepGrid& grid, const StoredCells& cells, const SweepSummary& summary) {
  report::Page page("Sweep: " + grid.name, fmt::format("scenario {}, model {}, {} points, estimators {}", grid.scenario,
                                                       grid.model, grid.size(), fmt::join(grid.estimators, ", ")));
  std::vector<std::string> meanings;
  for (const std::size_t m : shown_measures(grid)) meanings.push_back(grid.measures[m]->meaning);
  page.paragraph(fmt::format(
      "At each point the plant is simulated anew, and each estimator gets its motor signals. The curves show {}.",
      fmt::join(meanings, "; ")));
  for (const SweepAxis& axis : grid.axes) page.paragraph("Varied: " + axis_sentence(axis));
  if (!grid.seeds.empty())
    page.paragraph(fmt::format("Each combination of values is simulated with {} seeds.", grid.seeds.size()));
  const bool is_aggregated = grid.is_sampled || grid.axes.front().values.size() > kMaxPlaces ||
                             grid.combinations() / grid.axes.front().values.size() > kMaxSlices;
  if (is_aggregated || grid.n_seeds() > 1) page.paragraph("The bands are 95 % intervals of the means (Student's t).");
  if (summary.failures > 0) {
    page.verdict(report::VerdictKind::warning,
                 fmt::format("{} of {} runs of estimators failed and are gaps; sweep.csv says why, and how to repeat "
                             "them.",
                             summary.failures, grid.size() * grid.estimators.size()));
  }
  if (is_aggregated) add_means(page, grid, summary);
  else add_slices(page, grid, cells, summary);
  page.heading("Numbers");
  for (const std::size_t m : shown_measures(grid)) page.table(rows_of(grid, cells, m));
  if (grid.size() * grid.estimators.size() > kMaxRows) {
    page.paragraph(fmt::format("The first {} rows; sweep.csv has all, with more columns.", kMaxRows));
  }
  return page;
}

}  // namespace

SweepSummary write_sweep_report(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid,
                                const StoredCells& cells) {
  SweepSummary summary = write_sweep_table(files, folder / "sweep.csv", grid, cells);
  const auto differs = [](const SweepMeasure* measure) { return !measure->is_repeatable; };
  if (std::ranges::any_of(grid.measures, differs)) write_unrepeatable_table(files, folder / "time.csv", grid, cells);
  files.add(folder / "report.html", sweep_page(grid, cells, summary).html());
  add_sweep_pictures(files, folder, grid, cells, summary);
  return summary;
}

}  // namespace halyard

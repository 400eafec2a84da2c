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

/// A page with more curves or rows than this would not be read; sweep.csv has all.
constexpr std::size_t kMaxSlices = 12;
constexpr std::size_t kMaxRows = 300;

/// What a row shows of a joint over the first axis; slice counts the points of the other axes.
Chart slice_chart(const SweepGrid& grid, const StoredCells& cells, const SweepSummary& summary, std::size_t slice,
                  const ChartRow& row, std::size_t k) {
  const SweepAxis& axis = grid.axes.front();
  const std::size_t stride = grid.combinations() / axis.values.size();
  Chart chart = empty_chart(grid, summary, axis, row, k);
  for (const std::size_t i : row.subjects) {
    std::map<double, MeanWithInterval> places;
    for (std::size_t place = 0; place < axis.values.size(); ++place)
      for (std::size_t seed = 0; seed < grid.n_seeds(); ++seed) {
        const SweepCell cell = cells.read((place * stride + slice) * grid.n_seeds() + seed);
        places[axis.values[place]].add(cell.shown(grid, row.measure, i, k));
      }
    SweepSummary::Curve curve;
    for (const auto& [x, mean] : places) {
      curve.x.push_back(x);
      curve.means.push_back(mean);
    }
    const double shown_per_si = grid.shown_unit(row.measure, i, k).shown_per_si;
    chart.series.push_back(series_of(grid.subjects()[i], curve, shown_per_si, BandKind::interval));
  }
  return chart;
}

void add_slices(report::Page& page, const SweepGrid& grid, const StoredCells& cells, const SweepSummary& summary) {
  const std::size_t slices = grid.combinations() / grid.axes.front().values.size();
  for (std::size_t slice = 0; slice < slices; ++slice) {
    if (slices > 1) page.heading(grid.description(slice * grid.n_seeds(), 1));
    for (const ChartRow& row : chart_rows(grid)) {
      std::vector<Chart> charts;
      for (std::size_t k = 0; k < row.charts; ++k) charts.push_back(slice_chart(grid, cells, summary, slice, row, k));
      page.figure_row(charts);
    }
  }
}

/// For each axis the mean over everything else that varies.
void add_means(report::Page& page, const SweepGrid& grid, const SweepSummary& summary) {
  for (std::size_t a = 0; a < grid.axes.size(); ++a) {
    page.heading(fmt::format("Over {}, averaged over everything else that varies", grid.axes[a].label()));
    for (const ChartRow& row : chart_rows(grid)) page.figure_row(mean_charts(grid, summary, row, a));
  }
}

/// What a row shows at each point.
report::Table rows_of(const SweepGrid& grid, const StoredCells& cells, const ChartRow& shown) {
  const std::string& what = grid.measures[shown.measure]->shown_as;
  report::Table table;
  table.caption = static_cast<char>(std::toupper(what[0])) + what.substr(1);
  if (grid.measures_limits()) table.caption += " of " + grid.effects[shown.subjects.front()].name;
  else if (grid.measures[shown.measure]->is_of_joint)
    table.caption += fmt::format(" after the first {:g} s", grid.skip_s);
  for (const SweepAxis& axis : grid.axes) table.header.push_back(axis_label(axis));
  if (!grid.seeds.empty()) table.header.push_back("seed");
  table.header.push_back(grid.measures_limits() ? "effect" : "estimator");
  for (std::size_t k = 0; k < shown.charts; ++k) {
    const std::string unit = grid.shown_unit(shown.measure, shown.subjects.front(), k).shown;
    table.header.push_back(lower_case(joint_title(grid, shown, k)) + (unit.empty() ? "" : " [" + unit + "]"));
  }
  table.align.assign(table.header.size(), report::Align::right);
  table.align[grid.axes.size() + (grid.seeds.empty() ? 0 : 1)] = report::Align::left;
  const std::vector<std::string> names = grid.subjects();
  for (std::size_t point = 0; point < cells.size() && table.rows.size() < kMaxRows; ++point) {
    const SweepCell cell = cells.read(point);
    for (const std::size_t i : shown.subjects) {
      if (table.rows.size() == kMaxRows) break;
      std::vector<Cell> row;
      for (const double value : grid.values(cell.point)) row.emplace_back(fmt::format("{:.6g}", value));
      if (const auto seed = grid.seed(point)) row.emplace_back(std::to_string(*seed));
      row.emplace_back(names[i]);
      for (std::size_t k = 0; k < shown.charts; ++k)
        row.emplace_back(shown_number(cell.shown(grid, shown.measure, i, k), grid.shown_unit(shown.measure, i, k)));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

std::string axis_sentence(const SweepGrid& grid, const SweepAxis& axis) {
  const char* where = axis.applies_to == SweepAxis::Target::robot   ? ", in the robot alone, unknown to the estimators"
                      : axis.applies_to == SweepAxis::Target::model ? ", in the estimators' model alone"
                                                                    : ", in the robot and in the estimators' model";
  return fmt::format("{}, {} values{}{}.", fmt::join(axis.parameters, ", "), axis.values.size(),
                     axis.is_factor ? ", each a factor of the number" : "", grid.measures_limits() ? "" : where);
}

/// What happens at a point, and what the curves show.
std::string what_is_shown(const SweepGrid& grid) {
  if (grid.measures_limits())
    return fmt::format(
        "At each point the motion of the scenario is simulated with an arm as the model says, and the curves show {}. "
        "A mean counts only the points at which the effect can be seen. Gaps: at none of them. sweep.csv also has the "
        "size from which no other "
        "effect explains the same data about as well.",
        limits_measure().meaning);
  std::vector<std::string> meanings;
  for (const ChartRow& row : chart_rows(grid)) meanings.push_back(grid.measures[row.measure]->meaning);
  return fmt::format(
      "At each point the plant is simulated anew, and each estimator gets its motor signals. The curves show {}.",
      fmt::join(meanings, "; "));
}

report::Page sweep_page(const SweepGrid& grid, const StoredCells& cells, const SweepSummary& summary) {
  report::Page page("Sweep: " + grid.name,
                    fmt::format("scenario {}, model {}, {} points, {} {}", grid.scenario, grid.model, grid.size(),
                                grid.measures_limits() ? "limits of" : "estimators", fmt::join(grid.subjects(), ", ")));
  page.paragraph(what_is_shown(grid));
  for (const SweepAxis& axis : grid.axes) page.paragraph("Varied: " + axis_sentence(grid, axis));
  if (!grid.seeds.empty())
    page.paragraph(fmt::format("Each combination of values is simulated with {} seeds.", grid.seeds.size()));
  const bool is_aggregated = grid.is_sampled || grid.axes.front().values.size() > SweepSummary::kMostPlaces ||
                             grid.combinations() / grid.axes.front().values.size() > kMaxSlices;
  if (is_aggregated && band_of_means(grid) == BandKind::range)
    page.paragraph("The bands reach from the least to the greatest value.");
  else if (is_aggregated || grid.n_seeds() > 1)
    page.paragraph("The bands are 95 % intervals of the means (Student's t).");
  if (summary.failures > 0) {
    page.verdict(
        report::VerdictKind::warning,
        fmt::format("{} of {} {} failed and are gaps; sweep.csv says why, and how to repeat them.", summary.failures,
                    grid.size() * grid.n_subjects(), grid.measures_limits() ? "limits" : "runs of estimators"));
  }
  if (is_aggregated) add_means(page, grid, summary);
  else add_slices(page, grid, cells, summary);
  page.heading("Numbers");
  for (const ChartRow& row : chart_rows(grid)) page.table(rows_of(grid, cells, row));
  if (grid.size() * chart_rows(grid).front().subjects.size() > kMaxRows) {
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

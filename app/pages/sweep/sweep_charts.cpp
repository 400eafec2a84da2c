#include "app/pages/sweep/sweep_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

namespace halyard {

bool spans_decades(double least, double greatest, double decades) {
  return least > 0 && greatest >= least * std::pow(10, decades);
}

std::string axis_label(const SweepAxis& axis) {
  return axis.unit.empty() ? axis.label() : fmt::format("{} [{}]", axis.label(), axis.unit);
}

std::vector<ChartRow> chart_rows(const SweepGrid& grid) {
  std::vector<std::size_t> all(grid.n_subjects());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<ChartRow> rows;
  for (std::size_t m = 0; m < grid.measures.size(); ++m) {
    const std::size_t charts = grid.measures[m]->is_of_joint ? grid.units.size() : 1;
    if (grid.measures_limits())
      for (const std::size_t i : all) rows.push_back({m, {i}, charts});  // each has its own unit
    else if (grid.measures[m]->is_repeatable) rows.push_back({m, all, charts});
  }
  return rows;
}

std::string joint_title(const SweepGrid& grid, const ChartRow& row, std::size_t k) {
  return grid.measures[row.measure]->is_of_joint ? fmt::format("Joint {}", k + 1) : "All joints";
}

std::string lower_case(std::string title) {
  title[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(title[0])));
  return title;
}

std::string value_label(const SweepGrid& grid, const ChartRow& row, std::size_t k) {
  const std::size_t i = row.subjects.front();
  std::string text = grid.measures[row.measure]->shown_as;
  if (grid.measures_limits()) text += " of " + grid.effects[i].name + ", " + grid.effects[i].parameter;
  const std::string unit = grid.shown_unit(row.measure, i, k).shown;
  return unit.empty() ? text : fmt::format("{} [{}]", text, unit);
}

bool has_log_values(const SweepSummary& summary, const ChartRow& row, std::size_t k) {
  SweepSummary::Span all;
  for (const std::size_t i : row.subjects) {
    const SweepSummary::Span& span = summary.spans[row.measure][i][k];
    all = {std::min(all.least, span.least), std::max(all.greatest, span.greatest)};
  }
  return spans_decades(all.least, all.greatest, 2);
}

report::Chart empty_chart(const SweepGrid& grid, const SweepSummary& summary, const SweepAxis& axis,
                          const ChartRow& row, std::size_t k) {
  const auto [lowest, highest] = std::ranges::minmax(axis.values);
  return {.title = joint_title(grid, row, k),
          .x_label = axis_label(axis),
          .y_label = value_label(grid, row, k),
          .log_x = lowest > 0 && (axis.is_logarithmic || spans_decades(lowest, highest, 1)),
          // The same for all charts of a joint.
          .log_y = has_log_values(summary, row, k)};
}

report::Series series_of(const std::string& name, const SweepSummary::Curve& curve, double shown_per_si,
                         BandKind kind) {
  report::Series series{.name = name, .x = curve.x};
  report::Band band;
  for (const MeanWithInterval& place : curve.means) {
    series.y.push_back(shown_per_si * place.mean());
    const bool is_range = kind == BandKind::range && place.count() > 0;
    band.lower.push_back(shown_per_si * (is_range ? place.least() : place.mean() - place.half_width()));
    band.upper.push_back(shown_per_si * (is_range ? place.greatest() : place.mean() + place.half_width()));
  }
  if (std::ranges::any_of(curve.means, [](const auto& place) { return place.count() > 1; })) series.band = band;
  return series;
}

BandKind band_of_means(const SweepGrid& grid) {
  const bool has_one_place_a_value = grid.axes.size() == 1 && grid.axes[0].values.size() <= SweepSummary::kMostPlaces;
  return grid.is_sampled || has_one_place_a_value ? BandKind::interval : BandKind::range;
}

std::vector<report::Chart> mean_charts(const SweepGrid& grid, const SweepSummary& summary, const ChartRow& row,
                                       std::size_t a) {
  const std::vector<std::string> names = grid.subjects();
  std::vector<report::Chart> charts;
  for (std::size_t k = 0; k < row.charts; ++k) {
    report::Chart& chart = charts.emplace_back(empty_chart(grid, summary, grid.axes[a], row, k));
    for (const std::size_t i : row.subjects)
      chart.series.push_back(series_of(names[i], summary.curve(row.measure, a, i, k),
                                       grid.shown_unit(row.measure, i, k).shown_per_si, band_of_means(grid)));
  }
  return charts;
}

}  // namespace halyard

#include "app/pages/sweep/sweep_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace halyard {

bool spans_decades(double least, double greatest, double decades) {
  return least > 0 && greatest >= least * std::pow(10, decades);
}

std::string axis_label(const SweepAxis& axis) {
  return axis.unit.empty() ? axis.label() : fmt::format("{} [{}]", axis.label(), axis.unit);
}

std::vector<std::size_t> shown_measures(const SweepGrid& grid) {
  std::vector<std::size_t> shown;
  for (std::size_t m = 0; m < grid.measures.size(); ++m)
    if (grid.measures[m]->is_repeatable) shown.push_back(m);
  return shown;
}

std::size_t n_charts(const SweepGrid& grid, std::size_t m) {
  return grid.measures[m]->is_of_joint ? grid.units.size() : 1;
}

std::string joint_title(const SweepGrid& grid, std::size_t m, std::size_t k) {
  return grid.measures[m]->is_of_joint ? fmt::format("Joint {}", k + 1) : "All joints";
}

std::string lower_case(std::string title) {
  title[0] = static_cast<char>(std::tolower(title[0]));
  return title;
}

report::Chart empty_chart(const SweepGrid& grid, const SweepSummary& summary, const SweepAxis& axis, std::size_t m,
                          std::size_t k) {
  const auto [lowest, highest] = std::ranges::minmax(axis.values);
  const SweepSummary::Span& span = summary.spans[m][k];
  return {.title = joint_title(grid, m, k),
          .x_label = axis_label(axis),
          .y_label = grid.measures[m]->label(grid.units[k]),
          .log_x = lowest > 0 && (axis.is_logarithmic || spans_decades(lowest, highest, 1)),
          // The same for all charts of a joint.
          .log_y = spans_decades(span.least, span.greatest, 2)};
}

report::Series series_of(const std::string& name, const SweepSummary::Curve& curve, double shown_per_si) {
  report::Series series{.name = name, .x = curve.x};
  report::Band band;
  for (const MeanWithInterval& place : curve.means) {
    series.y.push_back(shown_per_si * place.mean());
    band.lower.push_back(shown_per_si * (place.mean() - place.half_width()));
    band.upper.push_back(shown_per_si * (place.mean() + place.half_width()));
  }
  if (std::ranges::any_of(curve.means, [](const auto& place) { return place.count() > 1; })) series.band = band;
  return series;
}

std::vector<report::Chart> mean_charts(const SweepGrid& grid, const SweepSummary& summary, std::size_t m,
                                       std::size_t a) {
  std::vector<report::Chart> charts;
  for (std::size_t k = 0; k < n_charts(grid, m); ++k) {
    report::Chart& chart = charts.emplace_back(empty_chart(grid, summary, grid.axes[a], m, k));
    const double shown_per_si = grid.measures[m]->shown_unit(grid.units[k]).shown_per_si;
    for (std::size_t i = 0; i < grid.estimators.size(); ++i)
      chart.series.push_back(series_of(grid.estimators[i], summary.curve(m, a, i, k), shown_per_si));
  }
  return charts;
}

}  // namespace halyard

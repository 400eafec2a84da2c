#include "app/pages/sweep/sweep_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace halyard {

bool spans_decades(double least, double greatest, double decades) {
  return least > 0 && greatest >= least * std::pow(10, decades);
}

std::string axis_label(const SweepAxis& axis) {
  return axis.unit.empty() ? axis.label() : fmt::format("{} [{}]", axis.label(), axis.unit);
}

report::Chart empty_chart(const SweepGrid& grid, const SweepSummary& summary, const SweepAxis& axis, std::size_t k) {
  const auto [lowest, highest] = std::ranges::minmax(axis.values);
  return {.title = fmt::format("Joint {}", k + 1),
          .x_label = axis_label(axis),
          .y_label = fmt::format("mean absolute error [{}]", grid.units[k].shown),
          .log_x = lowest > 0 && (axis.is_logarithmic || spans_decades(lowest, highest, 1)),
          // The same for all charts of a joint.
          .log_y = spans_decades(summary.spans[k].least, summary.spans[k].greatest, 2)};
}

report::Series series_of(const std::string& name, const SweepSummary::Curve& curve, double shown_per_si) {
  report::Series series{.name = name, .x = curve.x};
  report::Band band;
  for (const MeanWithInterval& error : curve.errors) {
    series.y.push_back(shown_per_si * error.mean());
    band.lower.push_back(shown_per_si * (error.mean() - error.half_width()));
    band.upper.push_back(shown_per_si * (error.mean() + error.half_width()));
  }
  if (std::ranges::any_of(curve.errors, [](const auto& error) { return error.count() > 1; })) series.band = band;
  return series;
}

report::Chart mean_chart(const SweepGrid& grid, const SweepSummary& summary, std::size_t a, std::size_t k) {
  report::Chart chart = empty_chart(grid, summary, grid.axes[a], k);
  for (std::size_t i = 0; i < grid.estimators.size(); ++i)
    chart.series.push_back(series_of(grid.estimators[i], summary.curve(a, i, k), grid.units[k].shown_per_si));
  return chart;
}

}  // namespace halyard

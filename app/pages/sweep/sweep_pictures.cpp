#include "app/pages/sweep/sweep_pictures.h"

#include <algorithm>
#include <numeric>

#include "app/pages/sweep/sweep_charts.h"
#include "app/report/figure_svg.h"

namespace halyard {
namespace {

/// Cells of a map that would not be seen.
constexpr std::size_t kMostCells = 100 * 100;

bool has_map(const SweepGrid& grid) {
  return grid.axes.size() == 2 && !grid.is_sampled && grid.combinations() <= kMostCells;
}

/// Places of the values in increasing order.
std::vector<std::size_t> increasing(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  return order;
}

std::vector<double> sorted(std::vector<double> values) {
  std::ranges::sort(values);
  return values;
}

/// The maps of an estimator by the m-th measure, still without values; the first axis to the right.
std::vector<report::HeatMap> empty_maps(const SweepGrid& grid, const SweepSummary& summary, std::size_t m,
                                        std::size_t i) {
  std::vector<report::HeatMap> maps;
  for (std::size_t k = 0; k < n_charts(grid, m); ++k) {
    const SweepSummary::Span& span = summary.spans[m][k];
    maps.push_back({.title = grid.estimators[i] + ", " + lower_case(joint_title(grid, m, k)),
                    .x_label = axis_label(grid.axes[0]),
                    .y_label = axis_label(grid.axes[1]),
                    .value_label = grid.measures[m]->label(grid.units[k]),
                    .x = sorted(grid.axes[0].values),
                    .y = sorted(grid.axes[1].values),
                    .log_value = spans_decades(span.least, span.greatest, 2)});
  }
  return maps;
}

/// A row for each measure and estimator.
std::vector<std::vector<report::HeatMap>> heat_maps(const SweepGrid& grid, const StoredCells& cells,
                                                    const SweepSummary& summary) {
  const std::size_t n_rows = grid.axes[1].values.size();
  std::vector<std::vector<report::HeatMap>> maps;
  for (const std::size_t m : shown_measures(grid))
    for (std::size_t i = 0; i < grid.estimators.size(); ++i) maps.push_back(empty_maps(grid, summary, m, i));
  for (const std::size_t row : increasing(grid.axes[1].values))
    for (const std::size_t column : increasing(grid.axes[0].values)) {
      std::vector<SweepCell> repeats;
      for (std::size_t seed = 0; seed < grid.n_seeds(); ++seed)
        repeats.push_back(cells.read((column * n_rows + row) * grid.n_seeds() + seed));
      auto maps_of_run = maps.begin();
      for (const std::size_t m : shown_measures(grid))
        for (std::size_t i = 0; i < grid.estimators.size(); ++i, ++maps_of_run)
          for (std::size_t k = 0; k < maps_of_run->size(); ++k) {
            MeanWithInterval mean;
            for (const SweepCell& cell : repeats) mean.add(cell.shown(grid, m, i, k));
            (*maps_of_run)[k].value.push_back(grid.measures[m]->shown_unit(grid.units[k]).shown_per_si * mean.mean());
          }
    }
  return maps;
}

}  // namespace

void add_sweep_pictures(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid,
                        const StoredCells& cells, const SweepSummary& summary) {
  std::vector<std::vector<report::Chart>> rows;
  for (const std::size_t m : shown_measures(grid))
    for (std::size_t a = 0; a < grid.axes.size(); ++a) rows.push_back(mean_charts(grid, summary, m, a));
  files.add(folder / "curves.svg", report::figure_svg(rows));
  if (has_map(grid)) files.add(folder / "heat_map.svg", report::heat_map_svg(heat_maps(grid, cells, summary)));
}

}  // namespace halyard

#include "app/pages/sweep/sweep_pictures.h"

#include <fmt/format.h>

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

/// [estimator][joint], the first axis to the right.
std::vector<std::vector<report::HeatMap>> error_maps(const SweepGrid& grid, const StoredCells& cells,
                                                     const SweepSummary& summary) {
  const std::vector<double>&first = grid.axes[0].values, &second = grid.axes[1].values;
  const std::vector<std::size_t> columns = increasing(first), rows = increasing(second);
  std::vector<std::vector<report::HeatMap>> maps(grid.estimators.size());
  for (std::size_t i = 0; i < maps.size(); ++i)
    for (std::size_t k = 0; k < grid.units.size(); ++k) {
      report::HeatMap map{.title = fmt::format("{}, joint {}", grid.estimators[i], k + 1),
                          .x_label = axis_label(grid.axes[0]),
                          .y_label = axis_label(grid.axes[1]),
                          .value_label = fmt::format("mean absolute error [{}]", grid.units[k].shown),
                          .log_value = spans_decades(summary.spans[k].least, summary.spans[k].greatest, 2)};
      for (const std::size_t column : columns) map.x.push_back(first[column]);
      for (const std::size_t row : rows) map.y.push_back(second[row]);
      maps[i].push_back(std::move(map));
    }
  for (const std::size_t row : rows)
    for (const std::size_t column : columns) {
      std::vector<MeanWithInterval> means(maps.size() * grid.units.size());
      for (std::size_t seed = 0; seed < grid.n_seeds(); ++seed) {
        const SweepCell cell = cells.read((column * second.size() + row) * grid.n_seeds() + seed);
        for (std::size_t m = 0; m < means.size(); ++m)
          means[m].add(cell.results[m / grid.units.size()].errors[m % grid.units.size()].mean_absolute);
      }
      for (std::size_t m = 0; m < means.size(); ++m) {
        const std::size_t k = m % grid.units.size();
        maps[m / grid.units.size()][k].value.push_back(grid.units[k].shown_per_si * means[m].mean());
      }
    }
  return maps;
}

}  // namespace

void add_sweep_pictures(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid,
                        const StoredCells& cells, const SweepSummary& summary) {
  std::vector<std::vector<report::Chart>> rows(grid.axes.size());
  for (std::size_t a = 0; a < grid.axes.size(); ++a)
    for (std::size_t k = 0; k < grid.units.size(); ++k) rows[a].push_back(mean_chart(grid, summary, a, k));
  files.add(folder / "curves.svg", report::figure_svg(rows));
  if (has_map(grid)) files.add(folder / "heat_map.svg", report::heat_map_svg(error_maps(grid, cells, summary)));
}

}  // namespace halyard

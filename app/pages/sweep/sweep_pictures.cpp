#include "app/pages/sweep/sweep_pictures.h"

#include <algorithm>
#include <cmath>
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

/// The maps of a subject in a row of charts, still without values; the first axis to the right.
std::vector<report::HeatMap> empty_maps(const SweepGrid& grid, const SweepSummary& summary, const ChartRow& row,
                                        const std::string& subject) {
  std::vector<report::HeatMap> maps;
  for (std::size_t k = 0; k < row.charts; ++k)
    maps.push_back({.title = subject + ", " + lower_case(joint_title(grid, row, k)),
                    .x_label = axis_label(grid.axes[0]),
                    .y_label = axis_label(grid.axes[1]),
                    .value_label = value_label(grid, row, k),
                    .x = sorted(grid.axes[0].values),
                    .y = sorted(grid.axes[1].values),
                    .log_value = has_log_values(summary, row, k)});
  return maps;
}

/// A row for each measure and subject.
std::vector<std::vector<report::HeatMap>> heat_maps(const SweepGrid& grid, const StoredCells& cells,
                                                    const SweepSummary& summary) {
  const std::vector<std::string> names = grid.subjects();
  const std::vector<ChartRow> rows = chart_rows(grid);
  const std::size_t n_seconds = grid.axes[1].values.size();
  std::vector<std::vector<report::HeatMap>> maps;
  for (const ChartRow& row : rows)
    for (const std::size_t i : row.subjects) maps.push_back(empty_maps(grid, summary, row, names[i]));
  for (const std::size_t second : increasing(grid.axes[1].values))
    for (const std::size_t first : increasing(grid.axes[0].values)) {
      std::vector<SweepCell> repeats;
      for (std::size_t seed = 0; seed < grid.n_seeds(); ++seed)
        repeats.push_back(cells.read((first * n_seconds + second) * grid.n_seeds() + seed));
      auto maps_of_subject = maps.begin();
      for (const ChartRow& row : rows)
        for (const std::size_t i : row.subjects) {
          for (std::size_t k = 0; k < row.charts; ++k) {
            MeanWithInterval mean;
            for (const SweepCell& cell : repeats) mean.add(cell.shown(grid, row.measure, i, k));
            const double shown_per_si = grid.shown_unit(row.measure, i, k).shown_per_si;
            (*maps_of_subject)[k].value.push_back(shown_per_si * mean.mean());
          }
          ++maps_of_subject;
        }
    }
  // An estimator may have no such measure.
  for (auto& row : maps)
    std::erase_if(row, [](const report::HeatMap& map) {
      return std::ranges::none_of(map.value, [](double value) { return std::isfinite(value); });
    });
  std::erase_if(maps, [](const auto& row) { return row.empty(); });
  return maps;
}

}  // namespace

void add_sweep_pictures(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid,
                        const StoredCells& cells, const SweepSummary& summary) {
  std::vector<std::vector<report::Chart>> rows;
  for (const ChartRow& row : chart_rows(grid))
    for (std::size_t a = 0; a < grid.axes.size(); ++a) rows.push_back(mean_charts(grid, summary, row, a));
  files.add(folder / "curves.svg", report::figure_svg(rows));
  const auto maps = has_map(grid) ? heat_maps(grid, cells, summary) : std::vector<std::vector<report::HeatMap>>();
  if (maps.empty()) files.remove(folder / "heat_map.svg");
  else files.add(folder / "heat_map.svg", report::heat_map_svg(maps));
}

}  // namespace halyard

#include "evaluation/sweep/sweep_table.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "evaluation/csv.h"

namespace halyard {
namespace {

std::vector<std::string> sweep_columns(const SweepGrid& grid) {
  std::vector<std::string> header = {"point"};
  for (const SweepAxis& axis : grid.axes) {
    header.push_back(fmt::format("{}{}", fmt::join(axis.parameters, " "), axis.is_factor ? " (factor)" : ""));
  }
  if (!grid.seeds.empty()) header.push_back("seed");
  for (const char* name : {"estimator", "joint", "unit", "samples", "mean_absolute_error", "rms_error", "peak_error",
                           "bias", "within_two_std", "failure", "repeat_with"}) {
    header.push_back(name);
  }
  return header;
}

void add_rows(CsvTable& table, const SweepGrid& grid, const SweepCell& cell) {
  for (std::size_t i = 0; i < cell.results.size(); ++i) {
    const std::string& failure = cell.results[i].failure;
    for (std::size_t k = 0; k < grid.units.size(); ++k) {
      const ErrorStatistics& error = cell.results[i].errors[k];
      table.add(std::to_string(cell.point));
      for (const double value : grid.values(cell.point)) table.add(value);
      if (const auto seed = grid.seed(cell.point)) table.add(std::to_string(*seed));
      table.add(grid.estimators[i]);
      table.add(std::to_string(k + 1));
      table.add(grid.units[k].si);
      table.add(std::to_string(error.samples));
      for (const double value : {error.mean_absolute, error.rms, error.peak, error.bias, error.within_two_std}) {
        table.add(value);
      }
      table.add(failure);
      table.add(failure.empty() ? "" : command_of_point(grid, cell.point));
    }
  }
}

}  // namespace

std::string command_of_point(const SweepGrid& grid, std::size_t point) {
  return fmt::format("halyard sweep {} --point {}", grid.file, point);
}

SweepSummary write_sweep_table(OutputFiles& files, const std::filesystem::path& path, const SweepGrid& grid,
                               const StoredCells& cells) {
  SweepSummary summary(grid);
  files.add_in_parts(path, [&](const OutputFiles::Append& append) {
    CsvTable table(sweep_columns(grid));
    for (std::size_t point = 0; point < cells.size(); ++point) {
      const SweepCell cell = cells.read(point);
      add_rows(table, grid, cell);
      append(table.take());
      summary.add(cell);
    }
  });
  return summary;
}

}  // namespace halyard

#include "evaluation/sweep/sweep_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "evaluation/csv.h"

namespace halyard {

std::string sweep_csv(const SweepGrid& grid, const std::vector<SweepCell>& cells) {
  std::vector<std::string> header = {"point"};
  for (const SweepAxis& axis : grid.axes) {
    header.push_back(fmt::format("{}{}", fmt::join(axis.parameters, " "), axis.is_factor ? " (factor)" : ""));
  }
  for (const char* name : {"estimator", "joint", "unit", "samples", "mean_absolute_error", "rms_error", "peak_error",
                           "bias", "within_two_std", "failure"}) {
    header.push_back(name);
  }
  CsvTable table(header);
  for (const SweepCell& cell : cells) {
    for (std::size_t i = 0; i < cell.results.size(); ++i) {
      for (std::size_t k = 0; k < grid.units.size(); ++k) {
        const ErrorStatistics& error = cell.results[i].errors[k];
        table.add(std::to_string(cell.point));
        for (const double value : grid.values(cell.point)) table.add(value);
        table.add(grid.estimators[i]);
        table.add(std::to_string(k + 1));
        table.add(grid.units[k].si);
        table.add(std::to_string(error.samples));
        for (const double value : {error.mean_absolute, error.rms, error.peak, error.bias, error.within_two_std}) {
          table.add(value);
        }
        table.add(cell.results[i].failure);
      }
    }
  }
  return table.text();
}

std::size_t count_failures(const std::vector<SweepCell>& cells) {
  std::size_t failures = 0;
  for (const SweepCell& cell : cells) {
    failures += std::ranges::count_if(cell.results, [](const auto& result) { return !result.failure.empty(); });
  }
  return failures;
}

}  // namespace halyard

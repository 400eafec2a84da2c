#include "evaluation/sweep/sweep_table.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "evaluation/csv.h"
#include "evaluation/shell_words.h"
#include "plugins/host/effect_module.h"

namespace halyard {
namespace {

/// Names of the columns that say which point it is.
std::vector<std::string> point_columns(const SweepGrid& grid) {
  std::vector<std::string> header = {"point"};
  for (const SweepAxis& axis : grid.axes) {
    header.push_back(fmt::format("{}{}", fmt::join(axis.parameters, " "), axis.is_factor ? " (factor)" : ""));
  }
  if (!grid.seeds.empty()) header.push_back("seed");
  header.push_back(grid.measures_limits() ? "effect" : "estimator");
  return header;
}

void add_point(CsvTable& table, const SweepGrid& grid, std::size_t point, const std::string& subject) {
  table.add(std::to_string(point));
  for (const double value : grid.values(point)) table.add(value);
  if (const auto seed = grid.seed(point)) table.add(std::to_string(*seed));
  table.add(subject);
}

std::vector<std::string> names_of_measured(const SweepGrid& grid, bool repeatable) {
  std::vector<std::string> names;
  for (const SweepMeasure* measure : grid.measures)
    for (const MeasuredColumn& column : measure->columns)
      if (measure->is_repeatable == repeatable) names.push_back(column.name);
  return names;
}

void add_measured(CsvTable& table, const SweepGrid& grid, bool repeatable, const std::vector<double>& values) {
  std::size_t column = 0;
  for (const SweepMeasure* measure : grid.measures)
    for (std::size_t i = 0; i < measure->columns.size(); ++i, ++column)
      if (measure->is_repeatable == repeatable) table.add(values[column]);
}

std::vector<std::string> sweep_columns(const SweepGrid& grid) {
  std::vector<std::string> header = point_columns(grid);
  if (grid.measures_limits()) header.push_back("parameter");
  header.insert(header.end(), {"joint", "unit"});
  for (const std::string& name : names_of_measured(grid, true)) header.push_back(name);
  header.insert(header.end(), {"failure", "repeat_with"});
  return header;
}

void add_rows(CsvTable& table, const SweepGrid& grid, const SweepCell& cell) {
  const std::vector<std::string> subjects = grid.subjects();
  for (std::size_t i = 0; i < cell.results.size(); ++i) {
    const std::string& failure = cell.results[i].failure;
    for (std::size_t k = 0; k < grid.units.size(); ++k) {
      add_point(table, grid, cell.point, subjects[i]);
      if (grid.measures_limits()) table.add(grid.effects[i].parameter);
      table.add(std::to_string(k + 1));
      table.add(grid.measures_limits() ? grid.effects[i].units[k] : grid.units[k].si);
      add_measured(table, grid, true, cell.results[i].values[k]);
      table.add(failure);
      table.add(failure.empty() ? "" : command_of_point(grid, cell.point));
    }
  }
}

}  // namespace

std::string command_of_point(const SweepGrid& grid, std::size_t point) {
  const std::vector<std::filesystem::path> modules(grid.effect_modules.begin(), grid.effect_modules.end());
  return fmt::format("halyard sweep {} --point {}{}", in_shell_quotes(grid.file), point, effects_options(modules));
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

void write_unrepeatable_table(OutputFiles& files, const std::filesystem::path& path, const SweepGrid& grid,
                              const StoredCells& cells) {
  std::vector<std::string> header = point_columns(grid);
  for (const std::string& name : names_of_measured(grid, false)) header.push_back(name);
  files.add_in_parts(path, [&](const OutputFiles::Append& append) {
    CsvTable table(header);
    for (std::size_t point = 0; point < cells.size(); ++point) {
      const SweepCell cell = cells.read(point);
      for (std::size_t i = 0; i < cell.results.size(); ++i) {
        add_point(table, grid, point, grid.estimators[i]);
        add_measured(table, grid, false, cell.results[i].values.at(0));
      }
      append(table.take());
    }
  });
}

}  // namespace halyard

#include "evaluation/sweep/sweep_merge.h"

#include <fmt/core.h>

#include <optional>
#include <stdexcept>
#include <utility>

#include "model/input_error.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

/// The cell from the first folder that has it.
std::optional<SweepCell> find_cell(const std::vector<fs::path>& folders, const SweepGrid& grid, std::size_t point) {
  for (const fs::path& folder : folders) {
    if (std::optional<SweepCell> cell = read_cell(folder, grid, point)) return cell;
  }
  return std::nullopt;
}

}  // namespace

std::vector<SweepCell> collect_cells(const std::vector<fs::path>& folders, const SweepGrid& grid) {
  std::vector<SweepCell> cells;
  std::size_t missing = 0, first_missing = 0;
  for (std::size_t point = 0; point < grid.size(); ++point) {
    if (std::optional<SweepCell> cell = find_cell(folders, grid, point)) {
      cells.push_back(std::move(*cell));
    } else if (missing++ == 0) {
      first_missing = point;
    }
  }
  if (missing > 0) {
    throw InputError(
        fmt::format("halyard merge: {} of {} points are in none of the folders, the first is point {} ({}); run the "
                    "missing parts, or name their folders too",
                    missing, grid.size(), first_missing, grid.description(first_missing)));
  }
  return cells;
}

SweepResult merge_sweep(OutputFiles& files, const std::vector<fs::path>& parts, const fs::path& out) {
  if (parts.empty()) throw std::invalid_argument("merge_sweep: no part");
  SweepResult whole{read_grid(parts.front()), {}};
  for (const fs::path& part : parts) {
    if (read_grid(part).id != whole.grid.id) {
      throw InputError(part.string() + ": holds another sweep than " + parts.front().string() +
                       "; merge parts of the same sweep, computed from the same files");
    }
  }
  whole.cells = collect_cells(parts, whole.grid);
  discard_other_sweep(files, out, whole.grid);
  write_grid(files, out, whole.grid);
  for (const SweepCell& cell : whole.cells) write_cell(files, out, whole.grid, cell);
  return whole;
}

}  // namespace halyard

#include "evaluation/sweep/sweep_merge.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "evaluation/sweep/sweep_store.h"
#include "model/input_error.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

/// The parts; after them `out`, if it is another folder: its journals are removed, so what they hold must not be lost.
std::vector<fs::path> with_out(std::vector<fs::path> parts, const fs::path& out) {
  const auto is_out = [&](const fs::path& part) {
    std::error_code none;
    return fs::equivalent(part, out, none);
  };
  if (std::ranges::none_of(parts, is_out)) parts.push_back(out);
  return parts;
}

}  // namespace

StoredCells collect_cells(const std::vector<fs::path>& folders, const SweepGrid& grid) {
  StoredCells cells(folders, grid);
  if (const std::vector<std::string> programs = cells.programs(); programs.size() > 1)
    throw InputError(
        fmt::format("halyard merge: the points are of different programs ({}; {}); compute all parts with "
                    "one of them",
                    name_of_program(programs[0]), name_of_program(programs[1])));
  const std::size_t missing = grid.size() - cells.count();
  if (missing == 0) return cells;
  std::size_t first = 0;
  while (cells.has(first)) ++first;
  throw InputError(
      fmt::format("halyard merge: {} of {} points are in none of the folders, the first is point {} ({}); run the "
                  "missing parts, or name their folders too",
                  missing, grid.size(), first, grid.description(first)));
}

void write_cells(OutputFiles& files, const fs::path& out, const SweepGrid& grid, const StoredCells& cells) {
  for (const fs::path& journal : journals_in(out)) files.remove(journal);
  files.add_in_parts(journal_path(out, {}), [&](const OutputFiles::Append& append) {
    append(journal_header(grid, cells.programs().front()));
    for (std::size_t point = 0; point < cells.size(); ++point) append(cells.line(point));
  });
}

SweepResult merge_sweep(OutputFiles& files, const std::vector<fs::path>& parts, const fs::path& out) {
  if (parts.empty()) throw std::invalid_argument("merge_sweep: no part");
  SweepGrid grid = read_grid(parts.front());
  for (const fs::path& part : parts) {
    if (read_grid(part).id != grid.id) {
      throw InputError(part.string() + ": holds another sweep than " + parts.front().string() +
                       "; merge parts of the same sweep, computed from the same files");
    }
  }
  refuse_other_sweep(out, grid);
  StoredCells cells = collect_cells(with_out(parts, out), grid);
  write_grid(files, out, grid);
  write_cells(files, out, grid, cells);
  return {std::move(grid), std::move(cells)};
}

}  // namespace halyard

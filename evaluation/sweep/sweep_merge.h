#pragma once
/// Merges the parts of a sweep. The result is the same as that of one computation.

#include <filesystem>
#include <vector>

#include "evaluation/sweep/sweep_grid.h"
#include "evaluation/sweep/sweep_store.h"

namespace halyard {

/// All cells of the grid [grid.size()], in the order of the points, each from the first folder that has it.
/// Throws InputError if a cell is in none of the folders, and as read_cell() does.
std::vector<SweepCell> collect_cells(const std::vector<std::filesystem::path>& folders, const SweepGrid& grid);

/// A whole sweep: its grid, and all its cells.
struct SweepResult {
  SweepGrid grid;
  std::vector<SweepCell> cells;  ///< [grid.size()], in the order of the points
};

/// Collects the cells of all parts and adds them to the files of the folder `out`, which may be one of the parts. Cells
/// and tables of another sweep are removed from `out` by files.commit().
/// Throws std::invalid_argument without parts, InputError if the parts are of different sweeps, and as collect_cells()
/// does.
SweepResult merge_sweep(OutputFiles& files, const std::vector<std::filesystem::path>& parts,
                        const std::filesystem::path& out);

}  // namespace halyard

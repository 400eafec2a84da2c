#pragma once
/// Merges the parts of a sweep. The result is the same as that of one computation.

#include <filesystem>
#include <vector>

#include "evaluation/sweep/sweep_cells.h"
#include "evaluation/sweep/sweep_grid.h"
#include "model/output/output_files.h"

namespace halyard {

/// All cells of the grid, each from the first folder that has it.
/// Throws InputError if a cell is in none of the folders, and as StoredCells does.
StoredCells collect_cells(const std::vector<std::filesystem::path>& folders, const SweepGrid& grid);

/// Adds one journal with all cells in the order of the points to the folder `out`. files.commit() removes its other
/// journals.
void write_cells(OutputFiles& files, const std::filesystem::path& out, const SweepGrid& grid, const StoredCells& cells);

/// A whole sweep: its grid, and all its cells.
struct SweepResult {
  SweepGrid grid;
  StoredCells cells;
};

/// Collects the cells of all parts and adds grid and cells to the files of the folder `out`, which may be one of the
/// parts. If it is none of them, what its journals hold counts after the parts: they are replaced.
/// Throws std::invalid_argument without parts, InputError if the parts, or what `out` holds, are of different sweeps,
/// and as collect_cells() does.
SweepResult merge_sweep(OutputFiles& files, const std::vector<std::filesystem::path>& parts,
                        const std::filesystem::path& out);

}  // namespace halyard

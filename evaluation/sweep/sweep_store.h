#pragma once
/// The folder of a sweep: DIR/sweep.json describes the grid, DIR/cells holds the results (sweep_cells.h).

#include <filesystem>
#include <string>

#include "evaluation/sweep/sweep_grid.h"
#include "model/output/output_files.h"

namespace halyard {

/// Throws InputError if the folder holds a sweep with another id: its results may be the work of days, and only their
/// owner knows that they can go. Throws also as read_grid() does.
void refuse_other_sweep(const std::filesystem::path& folder, const SweepGrid& grid);

void write_grid(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid);
/// Throws InputError if the folder has no sweep.json, or one that this program did not write.
SweepGrid read_grid(const std::filesystem::path& folder);
/// Writes the grid into the folder unless it is there. Throws as refuse_other_sweep() does.
void store_grid(const std::filesystem::path& folder, const SweepGrid& grid);

}  // namespace halyard

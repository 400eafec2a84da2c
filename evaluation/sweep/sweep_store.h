#pragma once
/// The folder of a sweep: DIR/sweep.json describes the grid, DIR/cells holds the results (sweep_cells.h).

#include <filesystem>
#include <string>

#include "evaluation/sweep/sweep_grid.h"
#include "model/output/output_files.h"

namespace halyard {

/// True if the folder holds results of a sweep with another id. Throws as read_grid() does.
bool holds_other_sweep(const std::filesystem::path& folder, const SweepGrid& grid);
/// Has cells and tables of such a sweep removed with the commit of `files`, so that new results are not mixed with old
/// ones.
void discard_other_sweep(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid);

/// Throws the InputError for a folder with another sweep. remedy: "remove it"; another folder is proposed, too.
[[noreturn]] void refuse_other_sweep(const std::filesystem::path& folder, const std::string& remedy);

/// Removes the journals of other sweeps from a folder whose sweep.json is of this one.
void remove_journals_of_others(const std::filesystem::path& folder, const SweepGrid& grid);

void write_grid(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid);
/// Throws InputError if the folder has no sweep.json, or one that this program did not write.
SweepGrid read_grid(const std::filesystem::path& folder);
/// Writes the grid into the folder unless it is there, and removes cells and tables of another sweep.
void store_grid(const std::filesystem::path& folder, const SweepGrid& grid);

}  // namespace halyard

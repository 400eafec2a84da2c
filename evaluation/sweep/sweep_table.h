#pragma once
/// The results of a sweep as one table.

#include <filesystem>

#include "evaluation/sweep/sweep_cells.h"
#include "evaluation/sweep/sweep_grid.h"
#include "evaluation/sweep/sweep_summary.h"
#include "model/output/output_files.h"

namespace halyard {

/// Adds a CSV file with one row per point, estimator or effect, and joint: the values of the axes, the seed where there
/// are several, what was measured in SI units, and the reason of a failure with the command that repeats it. Reads each
/// cell once, in the order of the points, and returns their summary.
SweepSummary write_sweep_table(OutputFiles& files, const std::filesystem::path& path, const SweepGrid& grid,
                               const StoredCells& cells);

/// Adds a CSV file with the columns that differ from run to run, with one row per point and estimator.
void write_unrepeatable_table(OutputFiles& files, const std::filesystem::path& path, const SweepGrid& grid,
                              const StoredCells& cells);

/// "halyard sweep stiffness.xml --point 12"
std::string command_of_point(const SweepGrid& grid, std::size_t point);

}  // namespace halyard

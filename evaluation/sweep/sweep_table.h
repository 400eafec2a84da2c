#pragma once
/// The results of a sweep as one table.

#include <cstddef>
#include <filesystem>
#include <vector>

#include "evaluation/sweep/sweep_grid.h"
#include "evaluation/sweep/sweep_store.h"

namespace halyard {

/// Writes a CSV file with one row per point, estimator and joint: the values of the axes, the errors in SI units, and
/// the reason of a failure. cells: [grid.size()], in the order of the points. Throws as write_file_whole() does.
void write_sweep_table(const std::filesystem::path& path, const SweepGrid& grid, const std::vector<SweepCell>& cells);

/// Number of estimator runs that failed.
std::size_t count_failures(const std::vector<SweepCell>& cells);

}  // namespace halyard

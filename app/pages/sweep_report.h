#pragma once

#include <filesystem>
#include <vector>

#include "evaluation/sweep/sweep_grid.h"
#include "evaluation/sweep/sweep_store.h"

namespace halyard {

/// Writes sweep.csv, one row per point, estimator and joint, and report.html with curves of the mean absolute error
/// over the first axis, for every value of the others. cells: [grid.size()], in the order of the points.
void write_sweep_report(const std::filesystem::path& folder, const SweepGrid& grid,
                        const std::vector<SweepCell>& cells);

/// Estimators' runs that failed.
std::size_t count_failures(const std::vector<SweepCell>& cells);

}  // namespace halyard

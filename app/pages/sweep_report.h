#pragma once

#include <filesystem>
#include <vector>

#include "evaluation/sweep/sweep_grid.h"
#include "evaluation/sweep/sweep_store.h"
#include "model/output/output_files.h"

namespace halyard {

/// Adds sweep.csv (evaluation/sweep/sweep_table.h), and report.html with curves of the mean absolute error over the
/// first axis, for every value of the other axes. cells: [grid.size()], in the order of the points.
void write_sweep_report(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid,
                        const std::vector<SweepCell>& cells);

}  // namespace halyard

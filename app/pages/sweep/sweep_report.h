#pragma once

#include <filesystem>

#include "evaluation/sweep/sweep_cells.h"
#include "evaluation/sweep/sweep_grid.h"
#include "evaluation/sweep/sweep_summary.h"
#include "model/output/output_files.h"

namespace halyard {

/// Adds sweep.csv and, if times are measured, time.csv (evaluation/sweep/sweep_table.h), and report.html with curves of
/// what is measured over the first axis, for every value of the other axes. Of samples, and of a grid with too many
/// curves to be read, the curves are means over bins of one parameter. Intervals of 95 % are drawn where a place of a
/// curve has several points.
SweepSummary write_sweep_report(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid,
                                const StoredCells& cells);

}  // namespace halyard

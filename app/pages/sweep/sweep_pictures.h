#pragma once

#include <filesystem>

#include "evaluation/sweep/sweep_cells.h"
#include "evaluation/sweep/sweep_grid.h"
#include "evaluation/sweep/sweep_summary.h"
#include "model/output/output_files.h"

namespace halyard {

/// Adds static pictures for papers. curves.svg: what each measure shows of each joint over each axis, averaged over
/// everything else that varies, with 95 % intervals. Of a grid of two axes also heat_map.svg: the same over both, a row
/// for each measure and estimator or effect, averaged over the seeds.
void add_sweep_pictures(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid,
                        const StoredCells& cells, const SweepSummary& summary);

}  // namespace halyard

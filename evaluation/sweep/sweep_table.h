#pragma once
/// The results of a sweep as one table.

#include <cstddef>
#include <string>
#include <vector>

#include "evaluation/sweep/sweep_grid.h"
#include "evaluation/sweep/sweep_store.h"

namespace halyard {

/// The text of a CSV file with one row per point, estimator and joint: the values of the axes, the errors in SI units,
/// and the reason of a failure. cells: [grid.size()], in the order of the points.
std::string sweep_csv(const SweepGrid& grid, const std::vector<SweepCell>& cells);

/// Number of estimator runs that failed.
std::size_t count_failures(const std::vector<SweepCell>& cells);

}  // namespace halyard

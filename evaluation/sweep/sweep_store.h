#pragma once
/// Where a sweep keeps its results: DIR/sweep.json describes the grid, DIR/cells/000012.json holds point 12. Each file
/// is complete or absent, so that a sweep goes on where it was stopped and its parts can be merged.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/judgement/error_statistics.h"
#include "evaluation/sweep/sweep_grid.h"

namespace halyard {

/// What came out at one point of the grid.
struct SweepCell {
  /// Of one estimator.
  struct Result {
    std::string failure;                  ///< why there are no errors; empty: there are
    std::vector<ErrorStatistics> errors;  ///< [n_joints], NaN after a failure
  };

  std::size_t point = 0;
  std::vector<Result> results;  ///< [n_estimators]
};

/// Whether the folder holds results of a sweep with another id. Throws as read_grid().
bool holds_other_sweep(const std::filesystem::path& folder, const SweepGrid& grid);
/// Removes cells and tables of such a sweep, so that nothing stale stands beside new results.
void discard_other_sweep(const std::filesystem::path& folder, const SweepGrid& grid);

void write_grid(const std::filesystem::path& folder, const SweepGrid& grid);
/// Throws InputError if the folder has no sweep.json, or one that this program did not write.
SweepGrid read_grid(const std::filesystem::path& folder);

void write_cell(const std::filesystem::path& folder, const SweepGrid& grid, const SweepCell& cell);
/// Nothing if there is none. Throws InputError for a cell of another sweep or a damaged one.
std::optional<SweepCell> read_cell(const std::filesystem::path& folder, const SweepGrid& grid, std::size_t point);
void remove_cell(const std::filesystem::path& folder, std::size_t point);

}  // namespace halyard

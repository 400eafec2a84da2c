#pragma once
/// Stored results of a sweep: DIR/sweep.json describes the grid, DIR/cells/000012.json holds point 12. Each file is
/// complete or absent, so that a stopped sweep can be resumed and its parts can be merged.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/judgement/error_statistics.h"
#include "evaluation/sweep/sweep_grid.h"
#include "model/output/output_files.h"

namespace halyard {

/// The results at one point of the grid.
struct SweepCell {
  /// The result of one estimator.
  struct Result {
    std::string failure;                  ///< why there are no errors; empty: no failure
    std::vector<ErrorStatistics> errors;  ///< [n_joints], NaN after a failure
  };

  std::size_t point = 0;
  std::vector<Result> results;  ///< [n_estimators]
};

/// True if the folder holds results of a sweep with another id. Throws as read_grid() does.
bool holds_other_sweep(const std::filesystem::path& folder, const SweepGrid& grid);
/// Has cells and tables of such a sweep removed with the commit of `files`, so that new results are not mixed with old
/// ones.
void discard_other_sweep(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid);

void write_grid(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid);
/// Throws InputError if the folder has no sweep.json, or one that this program did not write.
SweepGrid read_grid(const std::filesystem::path& folder);

void write_cell(OutputFiles& files, const std::filesystem::path& folder, const SweepGrid& grid, const SweepCell& cell);
/// Reads the cell of a point, if there is one. Throws InputError if the cell is damaged, of another sweep,
/// or of another point.
std::optional<SweepCell> read_cell(const std::filesystem::path& folder, const SweepGrid& grid, std::size_t point);
void remove_cell(const std::filesystem::path& folder, std::size_t point);

}  // namespace halyard

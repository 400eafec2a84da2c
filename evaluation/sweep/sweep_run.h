#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "evaluation/run/contained_run.h"
#include "evaluation/sweep/sweep_cells.h"
#include "evaluation/sweep/sweep_file.h"

namespace halyard {

/// Simulates a point and runs the estimators over its log, or computes the detection limits. A failure is stored in the
/// cell, not thrown. A fault of the machine (is_fault_of_the_machine) is thrown, not stored.
SweepCell run_point(const Sweep& sweep, std::size_t point, const ContainmentOptions& containment = {});

/// Throws InputError if an estimator of the sweep cannot be made, and std::runtime_error if it crashes or takes too
/// long as it is made: with the model of the first point, and with the least and the greatest value of each option that
/// an axis varies. `keep_going`: one that crashes or takes too long is left to the points, which fail one by one.
void check_estimators(const Sweep& sweep, const ContainmentOptions& containment = {}, bool keep_going = false);

/// Throws InputError if stored points are of another program than this one, which may compute other numbers.
/// on_any_processor: another instruction set does not count, as where nodes of a cluster go on with the points.
void refuse_other_programs(const StoredCells& stored, const std::filesystem::path& folder,
                           bool on_any_processor = false);

struct SweepRunOptions {
  int jobs = 0;  ///< threads; 0: one per core
  Shard shard = {};
  /// true: keep stored cells without a failure, of any shard; false: compute all cells of the shard again, which is
  /// refused if another journal holds some of them
  bool resume = false;
  ContainmentOptions containment = {};
  /// Called without `resume`, if the folder holds finished points of this sweep that will be computed again.
  std::function<void(std::size_t points)> discarding = {};
  /// Called once with done = 0 and then after each point; from any thread.
  std::function<void(std::size_t done, std::size_t total)> progress = {};
};

/// Computes the shard's cells in parallel. Each is on the disk when its point is done, in the journal of the shard
/// (sweep_cells.h); several shards may run into one folder at the same time. The result does not depend on the number
/// of jobs. Throws InputError if the folder holds another sweep, if points that count are of another program
/// (this_program.h), if another journal holds cells of a shard that is not resumed, or if an estimator cannot be made;
/// std::runtime_error if a cell cannot be written; and as run_point() does. An estimator that crashes as it is made
/// fails point by point.
void run_sweep(const Sweep& sweep, const std::filesystem::path& folder, const SweepRunOptions& options);

}  // namespace halyard

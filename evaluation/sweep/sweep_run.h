#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "evaluation/run/contained_run.h"
#include "evaluation/sweep/sweep_file.h"
#include "evaluation/sweep/sweep_store.h"

namespace halyard {

/// Part i of n of a grid: the points p with p mod n = i - 1.
struct Shard {
  std::size_t index = 1, count = 1;

  bool holds(std::size_t point) const { return point % count == index - 1; }
};

/// Simulates a point and runs the estimators over its log. A failure is stored in the cell, not thrown.
SweepCell run_point(const Sweep& sweep, std::size_t point, const ContainmentOptions& containment = {});

struct SweepRunOptions {
  int jobs = 0;  ///< threads; 0: one per core
  Shard shard = {};
  bool resume = false;  ///< true: keep stored cells; false: compute all cells of the shard again
  ContainmentOptions containment = {};
  /// Called once with done = 0 and then after each point; from any thread.
  std::function<void(std::size_t done, std::size_t total)> progress = {};
};

/// Computes the shard's cells in parallel and stores each in the folder when it is done. The result does not depend on
/// the number of jobs. If the folder holds another sweep, its cells and tables are removed first; with `resume`, an
/// InputError is thrown instead.
/// Throws InputError also if an estimator cannot be made.
void run_sweep(const Sweep& sweep, const std::filesystem::path& folder, const SweepRunOptions& options);

}  // namespace halyard

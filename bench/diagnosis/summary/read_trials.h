#pragma once
/// The trials of a draw, from the folders in which they were run, or from files with a line for each (result.h).

#include <filesystem>
#include <vector>

#include "bench/diagnosis/results/result.h"

namespace halyard::blind {

/// In the order of their file names. Throws InputError for a folder without trials, for a trial that is there twice (a
/// shard and its repetition), and for trials of different seeds, shares of outliers or thresholds (--rule): these are
/// different draws, and a share over them is of neither.
std::vector<Result> read_trials(const std::vector<std::filesystem::path>& sources);

}  // namespace halyard::blind

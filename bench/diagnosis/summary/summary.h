#pragma once
/// Counts of many trials: summary.md, and for further analysis confusion.csv and trials.csv.

#include <filesystem>
#include <vector>

#include "bench/diagnosis/results/result.h"

namespace halyard::blind {

/// Writes the files to `out`. Returns the acceptance table.
std::string write_summary(const std::filesystem::path& out, const std::vector<Result>& results);

}  // namespace halyard::blind

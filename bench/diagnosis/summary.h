#pragma once
/// Counts of many trials: summary.md, and to go on with effects.csv, detection.csv, confusion.csv, trials.csv.
///
/// An interval of a share is that of Clopper and Pearson, 95 %. The detection limit of an effect is the smallest
/// strength above which at least 90 % of the trials at hand name it first; likewise in multiples of its typical size.

#include <filesystem>
#include <vector>

#include "bench/diagnosis/result.h"
#include "transmission/arm_parameters.h"

namespace halyard::blind {

/// `limit`: strength above which an effect counts. `arm`: tells the typical sizes. The files are written to `out`.
void write_summary(const std::filesystem::path& out, const std::vector<Result>& results,
                   const ArmParameters<double>& arm, double limit);

}  // namespace halyard::blind

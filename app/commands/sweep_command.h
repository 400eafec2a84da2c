#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "evaluation/sweep/sweep_run.h"

namespace halyard {

/// Parses "2/5" as part 2 of 5. Throws InputError for other text.
Shard parse_shard(std::string_view text);

struct SweepCommandOptions {
  std::filesystem::path sweep;
  std::filesystem::path out;  ///< folder
  SweepRunOptions run;
};

/// halyard sweep: a parameter study over a grid, or a part of one.
void run_sweep_command(const SweepCommandOptions& options);

struct MergeCommandOptions {
  std::vector<std::filesystem::path> parts;  ///< folders of the parts of a sweep
  std::filesystem::path out;                 ///< folder; may be one of the parts
};

/// halyard merge: merges the parts of a sweep and writes the report of the whole sweep.
void run_merge_command(const MergeCommandOptions& options);

}  // namespace halyard

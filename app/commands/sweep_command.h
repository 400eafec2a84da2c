#pragma once

#include <filesystem>
#include <optional>
#include <string>
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

/// halyard sweep --point: computes a single point and prints its errors; a failure is one of the program.
void run_sweep_point(const SweepCommandOptions& options, std::size_t point);

struct SweepSlurmOptions {
  std::filesystem::path sweep, out;
  std::size_t nodes = 1;
  std::vector<std::string> sbatch_options;
  bool print_script = false;  ///< instead of submitting it
};

/// halyard sweep --slurm: submits the parts that are not finished as a job array.
void run_sweep_slurm(const SweepSlurmOptions& options);

/// halyard sweep --status: prints how far the sweep is, and what comes next.
void run_sweep_status(const std::filesystem::path& sweep, const std::filesystem::path& out);

struct MergeCommandOptions {
  std::vector<std::filesystem::path> parts;  ///< folders of the parts of a sweep
  std::filesystem::path out;                 ///< folder; may be one of the parts
};

/// halyard merge: merges the parts of a sweep and writes the report of the whole sweep.
void run_merge_command(const MergeCommandOptions& options);

}  // namespace halyard

#pragma once
/// A sweep as a job array of Slurm: each task computes one shard into the same folder.
///
///   DIR/slurm/job.sh        the script that sbatch got
///   DIR/slurm/job.json      {"job": "17", "parts": 4, "options": ["--time=1:00:00"]}
///   DIR/slurm/part_2.log    what shard 2 printed

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace halyard {

struct SlurmArray {
  std::filesystem::path sweep, out;  ///< as the user gave them
  std::size_t parts = 1;             ///< shards, each on a node of its own
  std::vector<std::size_t> tasks;    ///< shards to compute, 1-based
  std::vector<std::string> options;  ///< more options for sbatch, such as "--time=1:00:00"
};

/// Text of the script. It starts this program in the current folder, and can run again after its node was lost.
std::string slurm_script(const SlurmArray& array);

/// Stores the script and submits it; returns the number of the job.
/// Throws InputError if sbatch is not installed, and std::runtime_error if it refuses the script, with its message, or
/// if a file cannot be written, with the job's number if there is one.
std::string submit(const SlurmArray& array);

struct SubmittedArray {
  std::string job;
  std::size_t parts = 1;
  std::vector<std::string> options;  ///< as of SlurmArray
};
/// What was submitted last for this folder, if anything was. Throws InputError for a damaged file.
std::optional<SubmittedArray> submitted_array(const std::filesystem::path& out);

/// A task that Slurm has not finished.
struct ActiveTask {
  std::size_t task = 0;
  std::string state;  ///< "running on n2", "pending"
};
/// Empty where Slurm does not know the job any more. Throws std::runtime_error if it cannot be asked.
std::vector<ActiveTask> active_tasks(const std::string& job);

}  // namespace halyard

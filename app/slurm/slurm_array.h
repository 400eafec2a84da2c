#pragma once
/// A sweep as a job array of Slurm: each task computes one shard into the same folder.
///
///   DIR/slurm/job.sh        the script that sbatch got
///   DIR/slurm/job.json      {"sweep": id, "job": "17", "cluster": "", "parts": 4, "options": ["--time=1:00:00"]}
///   DIR/slurm/part_2.log    what shard 2 printed

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace halyard {

struct SlurmArray {
  std::string id;                    ///< of the sweep
  std::filesystem::path sweep, out;  ///< as the user gave them
  std::size_t parts = 1;             ///< shards, each on a node of its own
  std::vector<std::size_t> tasks;    ///< shards to compute, 1-based
  std::vector<std::string> options;  ///< more options for sbatch, such as "--time=1:00:00"
};

/// Text of the script. It starts this program in the current folder, and can run again after its node was lost.
std::string slurm_script(const SlurmArray& array);

/// A job array as Slurm knows it.
struct SlurmJob {
  std::string number;
  std::string cluster = {};  ///< empty: the one that is asked without a name

  /// "17", or "17 of cluster north"
  std::string label() const { return number + (cluster.empty() ? "" : " of cluster " + cluster); }
};

/// Stores the script and submits it.
/// Throws InputError if sbatch is not installed, and std::runtime_error if it refuses the script, with its message, or
/// if a file cannot be written, with the job's number if there is one.
SlurmJob submit(const SlurmArray& array);

struct SubmittedArray {
  SlurmJob job;
  std::size_t parts = 1;
  std::vector<std::string> options;  ///< as of SlurmArray
};
/// What was submitted last for this folder, if anything of the sweep with this id was. Throws InputError for a damaged
/// file.
std::optional<SubmittedArray> submitted_array(const std::filesystem::path& out, const std::string& id);

/// A task that Slurm has not finished.
struct ActiveTask {
  std::size_t task = 0;
  std::string state;  ///< "running on n2", "pending"
};
/// Empty where Slurm does not know the job any more. Throws std::runtime_error if it cannot be asked.
std::vector<ActiveTask> active_tasks(const SlurmJob& job);
/// The command that ends the job.
std::string cancel_command(const SlurmJob& job);

}  // namespace halyard

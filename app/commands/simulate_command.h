#pragma once

#include <filesystem>

namespace halyard {

struct SimulateOptions {
  std::filesystem::path scenario;
  std::filesystem::path robot;  ///< model file of the true robot; empty: the scenario's model
  std::filesystem::path out;    ///< measured log
};

/// Turns "LOG.csv" into "LOG.truth.csv"; appends ".truth.csv" to any other name.
std::filesystem::path truth_path(const std::filesystem::path& log);

/// halyard simulate: runs the plant. Writes the log of its sensors, and the ground truth into a second file beside the
/// log.
void run_simulate(const SimulateOptions& options);

}  // namespace halyard

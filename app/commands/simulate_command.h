#pragma once

#include <filesystem>

namespace halyard {

struct SimulateOptions {
  std::filesystem::path scenario;
  std::filesystem::path robot;  ///< model file of the true robot; empty: the scenario's model
  std::filesystem::path out;    ///< measured log
};

/// "LOG.csv" to "LOG.truth.csv"; ".truth.csv" is put behind any other name.
std::filesystem::path truth_path(const std::filesystem::path& log);

/// halyard simulate: runs the plant; writes the log of its sensors, and its ground truth beside it.
void run_simulate(const SimulateOptions& options);

}  // namespace halyard

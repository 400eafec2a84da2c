#pragma once

#include <filesystem>

namespace halyard {

struct ExperimentsOptions {
  std::filesystem::path out;        ///< folder
  std::filesystem::path examples;   ///< empty: the examples that belong to this program
};

/// halyard experiments: the paper's experiments A, B and C on the simulated RAVEN-II, with all built-in estimators,
/// beside the errors that the paper measured on the robot.
void run_experiments(const ExperimentsOptions& options);

}  // namespace halyard

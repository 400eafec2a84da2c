#pragma once

#include <filesystem>

namespace halyard {

struct ExperimentsOptions {
  std::filesystem::path out;         ///< folder
  std::filesystem::path examples;    ///< empty: the examples that belong to this program
  std::filesystem::path calibrated;  ///< model file that estimators are run with too; empty: identified here
  double duration_s = 0;             ///< of each experiment; 0: the scenarios' own
  bool effect_study = true;          ///< which effect makes how much of the error: most of the time
};

/// halyard experiments: the paper's experiments A, B and C on the simulated RAVEN-II with the effects that the paper's
/// robot is likely to have had, with all built-in estimators, beside the errors that the paper measured on the robot.
void run_experiments(const ExperimentsOptions& options);

}  // namespace halyard

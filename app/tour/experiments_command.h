#pragma once

#include <filesystem>

namespace halyard {

struct ExperimentsOptions {
  std::filesystem::path out;       ///< folder
  std::filesystem::path examples;  ///< empty: the examples that belong to this program
  /// file of a second model, with which the estimators are also run; empty: the command identifies this model
  std::filesystem::path calibrated;
  double duration_s = 0;  ///< of each experiment; 0: the durations of the scenarios
  /// also compute how much each effect contributes to the error; this takes most of the computing time
  bool effect_study = true;
};

/// halyard experiments: repeats the paper's experiments A, B and C in simulation. The simulated RAVEN-II has the
/// effects that the paper's robot probably had. All built-in estimators are run; their errors are shown beside those
/// that the paper measured on the robot.
void run_experiments(const ExperimentsOptions& options);

}  // namespace halyard

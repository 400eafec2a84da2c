#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace halyard {

struct CompareCommandOptions {
  std::filesystem::path data;   ///< a scenario if it ends in .xml, otherwise a log
  std::filesystem::path model;  ///< the estimators' model; empty: the scenario's own model file
  /// only if `data` is a scenario: model file of the true robot; empty: the scenario's model
  std::filesystem::path robot;
  std::vector<std::string> estimators;
  std::filesystem::path out;         ///< folder
  std::vector<std::string> columns;  ///< entries of --column
  bool use_joint_torque = false;
  double skip_s = 0.5;
  double step_limit_s = 10;     ///< longest time for a step of an estimator
  int runs = 1;                 ///< only if `data` is a scenario: number of seeds that are simulated
  std::optional<double> noise;  ///< in multiples of the filters' assumed noise; none: the scenario's own noise
};

/// halyard compare: compares estimators with the truth of a simulated scenario, or with the joint sensors of a log.
void run_compare(const CompareCommandOptions& options);

}  // namespace halyard

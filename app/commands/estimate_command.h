#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace halyard {

struct EstimateCommandOptions {
  std::filesystem::path model;
  std::string estimator;  ///< name or path of a plug-in
  std::filesystem::path data;
  std::filesystem::path out;
  std::vector<std::string> columns;  ///< entries of --column
  bool use_joint_torque = false;
  double skip_s = 0.5;  ///< duration at the start of the log that is not counted in the printed errors
};

/// halyard estimate: runs one estimator over a log. Prints its error where the log has joint sensors.
void run_estimate(const EstimateCommandOptions& options);

}  // namespace halyard

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace halyard {

struct IdentifyCommandOptions {
  std::filesystem::path model;
  std::vector<std::filesystem::path> data;
  std::filesystem::path holdout;     ///< empty: the last third of each log
  std::string parameters;            ///< kinds and keys of parameters, separated by commas
  std::filesystem::path out;         ///< folder
  std::vector<std::string> columns;  ///< entries of --column
};

/// halyard identify: identifies parameters of the model from logs with joint sensors, by a dual filter. Writes
/// model.xml, identify.json, convergence.csv and report.html.
void run_identify(const IdentifyCommandOptions& options);

}  // namespace halyard

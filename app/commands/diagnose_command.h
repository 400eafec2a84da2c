#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace halyard {

struct DiagnoseCommandOptions {
  std::filesystem::path model;
  std::vector<std::filesystem::path> data;  ///< training logs
  std::filesystem::path holdout;            ///< empty: the last third of each training log
  std::filesystem::path out;                ///< folder
  std::vector<std::string> columns;         ///< entries of --column
  int rehearsals = 0;                       ///< number of logs on which the diagnosis is rehearsed
  std::uint64_t seed = 1;                   ///< of the rehearsals
  bool progress_in_pipe = false;            ///< lines of progress even if stderr is not a terminal
};

/// halyard diagnose: finds the effects that the model lacks. Writes diagnosis.json, model.xml and report.html.
void run_diagnose(const DiagnoseCommandOptions& options);

}  // namespace halyard

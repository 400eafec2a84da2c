#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace halyard {

struct CheckOptions {
  std::filesystem::path file;  ///< a model, scenario or sweep, an estimator's module (.so), or a log (.csv)
  /// For a log: model of its arm. For a module: model of the arm with which it is tested; empty: the RAVEN-II.
  std::filesystem::path model;
  std::vector<std::string> columns;  ///< for a log: entries of --column
  bool kalman = false;               ///< for a module: also test it as a Kalman filter with halyard's noise
  /// For a module: longest time for the test of a promise.
  std::optional<double> time_limit_s = std::nullopt;
};

/// halyard check: validates a model, scenario or sweep file and prints a summary; or runs the conformance suite on an
/// estimator, in a child process; or checks a log against its arm (diagnosis/log_check) and prints the findings. Throws
/// InputError if the file is invalid, the estimator breaks a promise, or a finding about the log is gross.
void run_check(const CheckOptions& options);

}  // namespace halyard

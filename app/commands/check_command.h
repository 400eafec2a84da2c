#pragma once

#include <filesystem>

namespace halyard {

struct CheckOptions {
  std::filesystem::path file;   ///< a model, scenario or sweep, or an estimator's module (.so)
  std::filesystem::path model;  ///< for a module: the arm it is tried with; empty: the RAVEN-II
  bool kalman = false;          ///< for a module: it claims to be a Kalman filter with halyard's noise
  double time_limit_s = 10;     ///< for a module: of each promise
};

/// halyard check: validates a model, scenario or sweep file and prints a summary; or runs the conformance suite on an
/// estimator, in a child process. Throws InputError if the file is invalid or the estimator breaks a promise.
void run_check(const CheckOptions& options);

}  // namespace halyard

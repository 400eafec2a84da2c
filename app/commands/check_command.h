#pragma once

#include <filesystem>

namespace halyard {

struct CheckOptions {
  std::filesystem::path file;   ///< a model, scenario or sweep, or an estimator's module (.so)
  std::filesystem::path model;  ///< for a module: model of the arm with which it is tested; empty: the RAVEN-II
  bool kalman = false;          ///< for a module: also test it as a Kalman filter with halyard's noise
  double time_limit_s = 10;     ///< for a module: longest time for the test of a promise
};

/// halyard check: validates a model, scenario or sweep file and prints a summary; or runs the conformance suite on an
/// estimator, in a child process. Throws InputError if the file is invalid or the estimator breaks a promise.
void run_check(const CheckOptions& options);

}  // namespace halyard

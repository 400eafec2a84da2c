#pragma once
/// Reads the options of an estimator from their text. An option that the estimator does not read is an error.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/arm_model.h"

namespace halyard {

class OptionReader {
 public:
  /// `estimator`: its name, for messages.
  OptionReader(std::string estimator, const EstimatorOptions& options);

  /// A number within [lower, upper], or `standard` if the option is absent. Throws InputError for other text.
  double number(const std::string& name, double standard, double lower, double upper);
  /// One number for all joints, or n numbers separated by blanks; `standard` [n] if the option is absent.
  Eigen::VectorXd per_joint(const std::string& name, const Eigen::VectorXd& standard, double lower, double upper);
  /// Throws InputError if an option was never read; the message lists the known options.
  void finish() const;

 private:
  [[noreturn]] void fail(const std::string& name, const std::string& text, const std::string& expected) const;

  std::string estimator_;
  const EstimatorOptions& options_;
  std::vector<std::string> known_;
};

}  // namespace halyard

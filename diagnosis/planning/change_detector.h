#pragma once
/// Decides whether a diagnosis would detect a change of the residual, on the fitting rows. The rules are those of
/// judge.h for a single effect, without what effects that were found before may miss.
///
/// The change is what is left of it when the model's own numbers are refitted. It is detected if, beside the residual
/// of the model as given,
///
/// - the change, and what is left of it, are well above the floor of a channel;
/// - it makes up a sufficient share of a channel's mean square;
/// - the gain in log-likelihood over blocks is significant, by the t test or by the likelihood ratio.

#include <Eigen/Core>
#include <vector>

#include "diagnosis/fit/baseline_reach.h"
#include "diagnosis/judgement/paired_t.h"

namespace halyard {

class ChangeDetector {
 public:
  /// residual: the weighted rows of the model as given. level: the significance. Throws InputError if there are fewer
  /// than three blocks.
  ChangeDetector(const Evidence& evidence, const BaselineReach& reach, const Eigen::VectorXd& residual, double level);

  /// change: weighted rows; an empty one is never detected.
  bool detects(const Eigen::VectorXd& change) const;
  /// True if rows with this rest are told apart from the residual of the model as given.
  bool tells_from_reference(const Eigen::VectorXd& left) const;

 private:
  std::vector<double> mean_squares(const std::vector<double>& rows) const;
  std::vector<double> log_likelihood(const Eigen::VectorXd& left) const;

  const Evidence& evidence_;
  const BaselineReach& reach_;
  const Eigen::VectorXd& residual_;
  Eigen::VectorXd reference_;  ///< what refitted numbers leave of the residual
  std::vector<double> reference_square_, reference_ln_;
  double significant_t_ = 0, significant_gain_ = 0;
};

}  // namespace halyard

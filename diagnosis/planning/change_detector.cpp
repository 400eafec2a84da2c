#include "diagnosis/planning/change_detector.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/judgement/judge.h"
#include "model/input_error.h"
#include "model/statistics/distributions.h"

namespace halyard {

ChangeDetector::ChangeDetector(const Evidence& evidence, const BaselineReach& reach, const Eigen::VectorXd& residual,
                               double level)
    : evidence_(evidence), reach_(reach), residual_(residual), reference_(reach.take(residual).left) {
  reference_square_ = mean_squares(reach_.rows(reference_));
  reference_ln_ = log_likelihood(reference_);
  const double blocks = static_cast<double>(reference_ln_.size());
  if (blocks < 3)
    throw InputError(evidence.records().front().source + ": too short to judge by; expected some seconds");
  significant_gain_ = -std::log(level);
  significant_t_ = t_quantile(blocks - 1, level);
}

bool ChangeDetector::detects(const Eigen::VectorXd& change) const {
  if (change.size() == 0) return false;
  const Eigen::VectorXd left = reach_.take(residual_ + change).left;
  if (!evidence_.exceeds_floor(reach_.rows(left - reference_), kRule.above_floor) ||
      !evidence_.exceeds_floor(reach_.rows(change), kRule.above_floor))
    return false;
  const std::vector<double> square = mean_squares(reach_.rows(left));
  bool share = false;
  for (std::size_t c = 0; c < square.size(); ++c)
    share = share || square[c] - reference_square_[c] > kRule.share * square[c];
  const Paired gain = paired(difference(reference_ln_, log_likelihood(left)));
  return share && (gain.t > significant_t_ || gain.sum > significant_gain_);
}

bool ChangeDetector::tells_from_reference(const Eigen::VectorXd& left) const {
  const Paired p = paired(difference(reference_ln_, log_likelihood(left)));
  return p.t >= kRule.tell_apart && p.sum >= 2 * kRule.tell_apart * kRule.tell_apart;
}

/// [channel]
std::vector<double> ChangeDetector::mean_squares(const std::vector<double>& rows) const {
  std::vector<double> square(evidence_.channels(), 0), count(evidence_.channels(), 0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    square[evidence_.row_channel()[r]] += rows[r] * rows[r];
    count[evidence_.row_channel()[r]] += 1;
  }
  for (std::size_t c = 0; c < square.size(); ++c) square[c] /= std::max(1.0, count[c]);
  return square;
}

/// Of each block that has rows, as likelihood.h says.
std::vector<double> ChangeDetector::log_likelihood(const Eigen::VectorXd& left) const {
  const std::vector<double> rows = reach_.rows(left);
  const std::size_t channels = evidence_.channels();
  std::vector<double> square, count;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::size_t place = evidence_.row_block()[r] * channels + evidence_.row_channel()[r];
    if (place >= square.size())
      square.resize((evidence_.row_block()[r] + 1) * channels, 0), count.resize(square.size(), 0);
    square[place] += rows[r] * rows[r];
    count[place] += 1;
  }
  std::vector<double> ln;
  for (std::size_t block = 0; block < square.size(); block += channels) {
    double sum = 0, any = 0;
    for (std::size_t c = 0; c < channels; ++c) {
      const double n = count[block + c];
      if (n > 0) sum += block_log_likelihood(evidence_, c, n, square[block + c] / n, std::pow(evidence_.floor()[c], 2));
      any += n;
    }
    if (any > 0) ln.push_back(sum);
  }
  return ln;
}

}  // namespace halyard

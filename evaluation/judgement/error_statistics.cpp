#include "evaluation/judgement/error_statistics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace halyard {

namespace {

/// The smallest of the sizes that so large a share of them does not exceed.
double percentile(std::vector<double>& sizes, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(sizes.size()))) - 1;
  std::ranges::nth_element(sizes, sizes.begin() + rank);
  return sizes[rank];
}

}  // namespace

ErrorStatistics error_statistics(std::span<const double> estimate, std::span<const double> truth,
                                 std::span<const double> std_deviation) {
  if (estimate.size() != truth.size() || (!std_deviation.empty() && std_deviation.size() != estimate.size())) {
    throw std::invalid_argument("error_statistics: estimate, truth and standard deviation differ in length");
  }
  std::size_t with_std = 0, within = 0;
  double sum = 0, sum_absolute = 0, sum_squares = 0;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const double error = estimate[i] - truth[i];
    if (std::isnan(error)) continue;
    sizes.push_back(std::abs(error));
    sum += error;
    sum_absolute += std::abs(error);
    sum_squares += error * error;
    if (!std_deviation.empty() && std_deviation[i] > 0) {
      ++with_std;
      if (std::abs(error) <= 2 * std_deviation[i]) ++within;
    }
  }
  ErrorStatistics statistics;
  statistics.samples = sizes.size();
  if (sizes.empty()) return statistics;
  const double n = static_cast<double>(sizes.size());
  statistics.mean_absolute = sum_absolute / n;
  statistics.rms = std::sqrt(sum_squares / n);
  statistics.median_absolute = percentile(sizes, 0.5);
  statistics.percentile_95 = percentile(sizes, 0.95);
  statistics.peak = std::ranges::max(sizes);
  statistics.bias = sum / n;
  if (with_std > 0) statistics.within_two_std = static_cast<double>(within) / static_cast<double>(with_std);
  return statistics;
}

double improvement(const ErrorStatistics& error, const ErrorStatistics& baseline) {
  return 1 - error.mean_absolute / baseline.mean_absolute;
}

std::size_t first_counted_sample(std::span<const double> time, double skip_s) {
  if (time.empty()) return 0;
  // Half a nanosecond of slack: times that were printed in decimals meet the limit that they were meant to meet.
  return std::lower_bound(time.begin(), time.end(), time.front() + skip_s - 0.5e-9) - time.begin();
}

}  // namespace halyard

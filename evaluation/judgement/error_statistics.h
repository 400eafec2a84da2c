#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace halyard {

/// Errors e = x̂ - x of an estimate x̂ of the truth x, over the samples where both are known.
///
///   mean_absolute   Σ|e| / N          the paper's Eq. 18, which it calls RMS
///   rms             sqrt(Σe² / N)
///   median_absolute, percentile_95   the 50th and the 95th percentile of |e|
///   peak            max |e|
///   bias            Σe / N
///   within_two_std  share of samples with |e| <= 2 σ, where the estimator gives a standard deviation σ > 0
///
/// All but the last are in the unit of x. NaN if no sample counts.
struct ErrorStatistics {
  std::size_t samples = 0;  ///< N
  double mean_absolute = std::numeric_limits<double>::quiet_NaN();
  double rms = std::numeric_limits<double>::quiet_NaN();
  double median_absolute = std::numeric_limits<double>::quiet_NaN();
  double percentile_95 = std::numeric_limits<double>::quiet_NaN();
  double peak = std::numeric_limits<double>::quiet_NaN();
  double bias = std::numeric_limits<double>::quiet_NaN();
  double within_two_std = std::numeric_limits<double>::quiet_NaN();
};

/// Samples where either is NaN do not count. std_deviation may be empty.
/// Throws std::invalid_argument if the lengths differ.
ErrorStatistics error_statistics(std::span<const double> estimate, std::span<const double> truth,
                                 std::span<const double> std_deviation = {});

/// Relative improvement of the mean absolute error over a baseline: 1 - error / baseline. NaN without a baseline.
double improvement(const ErrorStatistics& error, const ErrorStatistics& baseline);

/// Index of the first sample with time >= time[0] + skip_s; time.size() if there is none.
std::size_t first_counted_sample(std::span<const double> time, double skip_s);

}  // namespace halyard

#pragma once
/// Statistics of autocorrelated samples.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace halyard {

/// ρ_l = Σ (x_i - mean)(x_i+l - mean) / Σ (x_i - mean)², l = 0 .. lags. NaN entries do not count.
std::vector<double> autocorrelation(std::span<const double> x, std::size_t lags);

/// Number of independent samples, N / (1 + 2 Σ ρ_l), at least 1. Σ ρ_l adds pairs of successive lags, and ends before
/// the first pair with ρ_l + ρ_l+1 <= 0.
/// Source: Geyer, "Practical Markov chain Monte Carlo", Statistical Science 7 (1992), initial positive sequence.
double effective_samples(std::span<const double> x);

/// The band in which the mean of x_i², i = 1 .. dof, lies with probability 95 % if the x_i are independent standard
/// normal numbers: quantiles of χ²(dof) / dof.
std::pair<double, double> chi_square_band(double dof);

/// Ratio of the root mean square of errors a to that of errors b at the same instants, and its 95 % interval.
struct PairedRatio {
  double ratio = 0, lower = 0, upper = 0;
  std::size_t block = 0;  ///< block length of the bootstrap, samples

  /// Significant at the 95 % level; both may be false.
  bool better() const { return upper < 1; }
  bool worse() const { return lower > 1; }
  /// The ratio of b to a.
  PairedRatio inverse() const { return {1 / ratio, 1 / upper, 1 / lower, block}; }
};

/// Circular block bootstrap: blocks are drawn with replacement, the same blocks for both errors. The ends of the
/// interval are percentiles of 2000 ratios. A block has 2 N / n samples, where n = effective_samples() of a² - b². This
/// is twice the number of samples that carry the information of one independent sample. Samples where either error is
/// NaN do not count. NaN without samples.
/// Source: Politis and Romano, "A circular block-resampling procedure for stationary data" (1992).
PairedRatio paired_ratio(std::span<const double> a, std::span<const double> b, std::uint64_t seed = 1);

/// The same for independent runs, which are drawn with replacement. squares: one pair for each run, the sums of squares
/// of a and of b.
PairedRatio paired_ratio_of_runs(std::span<const std::pair<double, double>> squares, std::uint64_t seed = 1);

}  // namespace halyard

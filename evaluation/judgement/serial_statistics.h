#pragma once
/// Statistics of samples that follow each other in time and say partly the same.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace halyard {

/// ρ_l = Σ (x_i - mean)(x_i+l - mean) / Σ (x_i - mean)², l = 0 .. lags. NaN entries do not count.
std::vector<double> autocorrelation(std::span<const double> x, std::size_t lags);

/// N / (1 + 2 Σ ρ_l), at least 1: the sum goes over pairs of lags until a pair's sum is no longer positive.
/// Source: Geyer, "Practical Markov chain Monte Carlo", Statistical Science 7 (1992), initial positive sequence.
double effective_samples(std::span<const double> x);

/// 95 % of means of so many squares of independent normal numbers lie in it: quantiles of χ²(dof) / dof.
std::pair<double, double> chi_square_band(double dof);

/// Root mean square of errors a over that of errors b, which were made at the same instants, and its 95 % interval.
struct PairedRatio {
  double ratio = 0, lower = 0, upper = 0;
  std::size_t block = 0;  ///< samples that were drawn together

  /// At the 95 % level; neither may hold.
  bool better() const { return upper < 1; }
  bool worse() const { return lower > 1; }
  /// The second over the first.
  PairedRatio inverse() const { return {1 / ratio, 1 / upper, 1 / lower, block}; }
};

/// By circular block bootstrap: blocks of twice the samples that say one thing, drawn with replacement, both errors
/// together; percentiles of 2000 ratios. Where either error is NaN a sample does not count. NaN without samples.
/// Source: Politis and Romano, "A circular block-resampling procedure for stationary data" (1992).
PairedRatio paired_ratio(std::span<const double> a, std::span<const double> b, std::uint64_t seed = 1);

/// The same of independent runs: sums of squares of a and of b, one pair a run, drawn with replacement.
PairedRatio paired_ratio_of_runs(std::span<const std::pair<double, double>> squares, std::uint64_t seed = 1);

}  // namespace halyard

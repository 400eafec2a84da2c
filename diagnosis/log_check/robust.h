#pragma once
/// Statistics that a few wrong samples do not change. NaN counts as missing.

#include <vector>

namespace halyard {

/// Width of the central 98 % of the samples; 0 without samples.
double spread(const std::vector<double>& x);

/// The mean time from a sample to the next, holes of more than five usual intervals left out. Filters average so many
/// of uneven samples. 1 for a single sample or none.
double mean_interval(const std::vector<double>& times);

/// The samples at which both of two signals are finite.
struct FinitePairs {
  std::vector<double> x, y;
};
FinitePairs finite_pairs(const std::vector<double>& x, const std::vector<double>& y);

/// Relation of a reading to what is expected of it, from their changes over a fixed number of samples.
struct Slope {
  double slope = 0;      ///< minimises Σ|Δq - s Δp|
  double explained = 0;  ///< 1 - Σ|Δq - s Δp| / Σ|Δq|
};
Slope slope_of(const std::vector<double>& reading, const std::vector<double>& expected, std::size_t change);

/// Correlation of two signals, each clipped to its central 98 %, and the ratio of their standard deviations.
struct Correlation {
  double r = 0;
  double size = 0;  ///< standard deviation of y over that of x
  std::size_t n = 0;
};
Correlation correlation_of(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace halyard

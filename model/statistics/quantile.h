#pragma once
/// Quantiles of samples. NaN and infinite values count as missing.

#include <utility>
#include <vector>

namespace halyard {

/// Element round(share (n - 1)), counted from 0, of the n sorted samples. share: 0 to 1. NaN without samples.
double quantile(std::vector<double> x, double share);
/// Of an even number of samples, the upper one of the two in the middle.
inline double median(std::vector<double> x) { return quantile(std::move(x), 0.5); }

}  // namespace halyard

#pragma once
/// The paired t test: are differences that belong together above zero?
///
///   t = mean / √(Σ (d - mean)² / (N (N - 1))),   p from Student's distribution of N - 1 degrees of freedom

#include <vector>

namespace halyard {

/// Sum of the differences, and how many standard errors their mean lies above zero; 0 where they do not scatter.
struct Paired {
  double sum = 0, t = 0;
  int pairs = 0;
};

Paired paired(const std::vector<double>& differences);
/// The probability of such a t or more if the mean were zero, one-sided; 1 of fewer than three pairs.
double p_value(const Paired& p);

}  // namespace halyard

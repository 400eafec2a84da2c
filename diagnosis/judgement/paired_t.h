#pragma once
/// The paired t test: is the mean of paired differences above zero?
///
///   t = mean / √(Σ (d - mean)² / (N (N - 1))),   p from Student's distribution of N - 1 degrees of freedom

#include <vector>

namespace halyard {

/// sum: of the differences; t: their mean in standard errors, 0 if all differences are equal.
struct Paired {
  double sum = 0, t = 0;
  int pairs = 0;
};

Paired paired(const std::vector<double>& differences);
/// One-sided probability of a t this large or larger if the mean were zero; 1 for fewer than three pairs.
double p_value(const Paired& p);

}  // namespace halyard

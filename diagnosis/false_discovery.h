#pragma once
/// p values of many tests, so that a threshold on them bounds the expected share, among all that pass it, of those where
/// there is nothing.
///
///   p'_(k) = min_{j >= k} (m / j) p_(j),   p_(1) <= ... <= p_(m)
///
/// Benjamini and Hochberg, J. R. Stat. Soc. B 57 (1995) 289-300; it holds for independent tests and for positively
/// dependent ones (Benjamini and Yekutieli, Ann. Stat. 29 (2001) 1165-1188), which those of candidates that explain the
/// same residual are taken to be.

#include <vector>

namespace halyard {

/// p' in the order of p.
std::vector<double> false_discovery_rates(const std::vector<double>& p);

}  // namespace halyard

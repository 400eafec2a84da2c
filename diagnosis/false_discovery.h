#pragma once
/// p values of many tests, so that a threshold on them bounds the share of false ones among all that pass it.
///
///   p'_(k) = min_{j >= k} (m / j) p_(j),   p_(1) <= ... <= p_(m)
///
/// Benjamini and Hochberg, J. R. Stat. Soc. B 57 (1995) 289-300; it holds for tests that are positively dependent, as
/// those of candidates that explain the same residual are (Benjamini and Yekutieli, Ann. Stat. 29 (2001) 1165-1188).

#include <vector>

namespace halyard {

/// p' in the order of p.
std::vector<double> false_discovery_rates(const std::vector<double>& p);

}  // namespace halyard

#pragma once
/// Adjusts the p values of many tests, so that a threshold on them bounds the false discovery rate: the expected share
/// of false discoveries among all tests that pass.
///
///   p'_(k) = min_{j >= k} (m / j) p_(j),   p_(1) <= ... <= p_(m)
///
/// Source: Benjamini and Hochberg, J. R. Stat. Soc. B 57 (1995) 289-300. It holds for independent tests and for
/// positively dependent ones (Benjamini and Yekutieli, Ann. Stat. 29 (2001) 1165-1188). Tests of candidates that
/// explain the same residual are assumed to be positively dependent.

#include <vector>

namespace halyard {

/// p' in the order of p.
std::vector<double> false_discovery_rates(const std::vector<double>& p);

}  // namespace halyard

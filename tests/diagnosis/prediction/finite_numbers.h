#pragma once
/// Residuals as one list of numbers that can be compared.

#include <cmath>
#include <vector>

#include "diagnosis/prediction/prediction.h"

namespace halyard {

/// Of all channels, without NaN.
inline std::vector<double> finite_numbers(const Residuals& r) {
  std::vector<double> all;
  for (const auto& channel : r.channel)
    for (const double x : channel)
      if (std::isfinite(x)) all.push_back(x);
  return all;
}

}  // namespace halyard

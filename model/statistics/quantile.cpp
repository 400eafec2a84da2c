#include "model/statistics/quantile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace halyard {

double quantile(std::vector<double> x, double share) {
  std::erase_if(x, [](double v) { return !std::isfinite(v); });
  if (x.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto at = x.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(x.size() - 1) + 0.5);
  std::nth_element(x.begin(), at, x.end());
  return *at;
}

}  // namespace halyard

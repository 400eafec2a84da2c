#include "diagnosis/judgement/false_discovery.h"

#include <algorithm>
#include <numeric>

namespace halyard {

std::vector<double> false_discovery_rates(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> rate(p.size());
  double least = 1;
  for (std::size_t k = order.size(); k-- > 0;) {
    least = std::min(least, static_cast<double>(p.size()) / static_cast<double>(k + 1) * p[order[k]]);
    rate[order[k]] = least;
  }
  return rate;
}

}  // namespace halyard

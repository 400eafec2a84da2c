#include "diagnosis/log_check/robust.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/statistics/quantile.h"

namespace halyard {

double spread(const std::vector<double>& x) {
  const double width = quantile(x, 0.99) - quantile(x, 0.01);
  return std::isfinite(width) ? width : 0;
}

double mean_interval(const std::vector<double>& times) {
  constexpr double kHole = 5;  // usual intervals
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  if (steps.empty()) return 1;
  const double longest = kHole * median(steps);
  std::erase_if(steps, [&](double step) { return step > longest; });
  return std::accumulate(steps.begin(), steps.end(), 0.0) / static_cast<double>(steps.size());
}

Slope slope_of(const std::vector<double>& reading, const std::vector<double>& expected, std::size_t change) {
  struct Change {
    double slope, dq, dp;
  };
  std::vector<Change> changes;
  double weight = 0, all = 0;
  for (std::size_t i = change; i < std::min(reading.size(), expected.size()); ++i) {
    const double dq = reading[i] - reading[i - change], dp = expected[i] - expected[i - change];
    if (!std::isfinite(dq) || !std::isfinite(dp) || dp == 0) continue;
    changes.push_back({dq / dp, dq, dp});
    weight += std::abs(dp), all += std::abs(dq);
  }
  if (changes.empty() || all == 0) return {};
  std::ranges::sort(changes, {}, &Change::slope);
  Slope result;
  double below = 0;
  for (const Change& c : changes) {
    below += std::abs(c.dp);
    result.slope = c.slope;
    if (below >= weight / 2) break;
  }
  double left = 0;
  for (const Change& c : changes) left += std::abs(c.dq - result.slope * c.dp);
  result.explained = 1 - left / all;
  return result;
}

FinitePairs finite_pairs(const std::vector<double>& x, const std::vector<double>& y) {
  FinitePairs pairs;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
    if (std::isfinite(x[i]) && std::isfinite(y[i])) pairs.x.push_back(x[i]), pairs.y.push_back(y[i]);
  return pairs;
}

Correlation correlation_of(const std::vector<double>& x, const std::vector<double>& y) {
  auto [a, b] = finite_pairs(x, y);
  Correlation result{.n = a.size()};
  if (a.size() < 3) return result;
  double mean_a = 0, mean_b = 0, aa = 0, ab = 0, bb = 0;
  for (auto* signal : {&a, &b}) {
    const double low = quantile(*signal, 0.01), high = quantile(*signal, 0.99);
    double& mean = signal == &a ? mean_a : mean_b;
    for (double& v : *signal) v = std::clamp(v, low, high), mean += v / static_cast<double>(signal->size());
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  if (aa > 0 && bb > 0) result.r = ab / std::sqrt(aa * bb), result.size = std::sqrt(bb / aa);
  return result;
}

}  // namespace halyard

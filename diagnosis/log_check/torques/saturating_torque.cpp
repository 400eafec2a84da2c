#include "diagnosis/log_check/torques/saturating_torque.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/log_check/robust.h"
#include "model/statistics/quantile.h"

namespace halyard {
namespace {

/// Least Σ (y - f x - c sgn x)² over f in its range and all c.
double left_by_unit(const FinitePairs& t, double least, double largest) {
  const double n = static_cast<double>(t.x.size());
  double sx = 0, sy = 0, xx = 0, xy = 0;  // of |x| and y sgn x
  for (std::size_t i = 0; i < t.x.size(); ++i) {
    const double x = std::abs(t.x[i]), y = std::copysign(1, t.x[i]) * t.y[i];
    sx += x, sy += y, xx += x * x, xy += x * y;
  }
  const double variance = xx - sx * sx / n;
  const double f = std::clamp(variance > 0 ? (xy - sx * sy / n) / variance : least, least, largest);
  const double c = (sy - f * sx) / n;
  double left = 0;
  for (std::size_t i = 0; i < t.x.size(); ++i) left += std::pow(t.y[i] - f * t.x[i] - c * std::copysign(1, t.x[i]), 2);
  return left;
}

/// Least Σ (y - x + ρ (x - clamp(x, -L, L)))² over ρ.
double left_by_limit(const FinitePairs& t, double limit) {
  const auto beyond = [&](double x) { return x - std::clamp(x, -limit, limit); };
  double gg = 0, gd = 0;
  for (std::size_t i = 0; i < t.x.size(); ++i) {
    const double g = beyond(t.x[i]);
    gg += g * g, gd += g * (t.x[i] - t.y[i]);
  }
  const double share = gg > 0 ? std::clamp(gd / gg, 0.0, 1.0) : 0;
  double left = 0;
  for (std::size_t i = 0; i < t.x.size(); ++i) left += std::pow(t.y[i] - t.x[i] + share * beyond(t.x[i]), 2);
  return left;
}

}  // namespace

double evidence_of_saturation(const std::vector<double>& x, const std::vector<double>& y, double least_factor,
                              double largest_factor, double independent) {
  constexpr int kLimits = 50;  // quantiles of |x| that are tried: the best one is then within 2 % of the samples
  const FinitePairs t = finite_pairs(x, y);
  if (t.x.empty()) return 0;
  std::vector<double> size;
  for (const double v : t.x) size.push_back(std::abs(v));
  double saturated = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kLimits; ++i)
    saturated = std::min(saturated, left_by_limit(t, quantile(size, (i + 0.5) / kLimits)));
  const double unit = left_by_unit(t, least_factor, largest_factor);
  if (!(unit > 0)) return 0;
  return 0.5 * independent * std::log(unit / std::max(saturated, std::numeric_limits<double>::min()));
}

}  // namespace halyard

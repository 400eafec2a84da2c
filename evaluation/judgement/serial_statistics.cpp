#include "evaluation/judgement/serial_statistics.h"

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <cmath>
#include <limits>

#include "estimators/distributions.h"

namespace halyard {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr int kDraws = 2000;

std::vector<double> without_nan(std::span<const double> x) {
  std::vector<double> kept;
  for (const double v : x)
    if (!std::isnan(v)) kept.push_back(v);
  return kept;
}

/// Samples less their mean, and the sum of their squares.
struct Centered {
  std::vector<double> x;
  double squares = 0;
};

Centered centered(std::span<const double> samples) {
  Centered c{.x = without_nan(samples)};
  double mean = 0;
  for (const double v : c.x) mean += v;
  mean /= static_cast<double>(std::max<std::size_t>(c.x.size(), 1));
  for (double& v : c.x) {
    v -= mean;
    c.squares += v * v;
  }
  return c;
}

/// Appends ρ of the lags from rho.size() up to at least `lags`. Lags are summed side by side, because each sum alone
/// waits for its last addition.
void append_correlations(const Centered& c, std::size_t lags, std::vector<double>& rho) {
  constexpr std::size_t kTogether = 8;
  const std::size_t n = c.x.size();
  while (rho.size() <= lags) {
    const std::size_t first = rho.size();
    double sum[kTogether] = {};
    std::size_t i = 0;
    for (; i + first + kTogether <= n; ++i)
      for (std::size_t k = 0; k < kTogether; ++k) sum[k] += c.x[i] * c.x[i + first + k];
    for (; i + first < n; ++i)
      for (std::size_t k = 0; i + first + k < n; ++k) sum[k] += c.x[i] * c.x[i + first + k];
    for (std::size_t k = 0; k < kTogether; ++k)
      rho.push_back(c.squares > 0 ? sum[k] / c.squares : static_cast<double>(first + k == 0));
  }
}

/// Percentiles of the ratios that draw(random) gives.
template <class Draw>
PairedRatio interval(double ratio, std::size_t block, std::uint64_t seed, const Draw& draw) {
  boost::random::mt19937_64 random(seed);
  std::vector<double> ratios;
  for (int i = 0; i < kDraws; ++i) ratios.push_back(draw(random));
  std::ranges::sort(ratios);
  const auto at = [&](double share) { return ratios[static_cast<std::size_t>(share * (kDraws - 1) + 0.5)]; };
  return {ratio, at(0.025), at(0.975), block};
}

}  // namespace

std::vector<double> autocorrelation(std::span<const double> x, std::size_t lags) {
  std::vector<double> rho;
  append_correlations(centered(x), lags, rho);
  rho.resize(lags + 1);
  return rho;
}

double effective_samples(std::span<const double> x) {
  const Centered c = centered(x);
  const std::size_t n = c.x.size();
  double sum = 0;
  std::vector<double> rho;
  for (std::size_t l = 1; l + 1 < n; l += 2) {
    append_correlations(c, l + 1, rho);
    const double pair = rho[l] + rho[l + 1];
    if (pair <= 0) break;
    sum += pair;
  }
  return std::max(1.0, static_cast<double>(n) / (1 + 2 * sum));
}

std::pair<double, double> chi_square_band(double dof) {
  return {chi_square_quantile(dof, 0.025) / dof, chi_square_quantile(dof, 0.975) / dof};
}

PairedRatio paired_ratio(std::span<const double> a, std::span<const double> b, std::uint64_t seed) {
  std::vector<double> difference;
  std::vector<std::pair<double, double>> before = {{0, 0}};  // sums of squares of all samples before
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    difference.push_back(a[i] * a[i] - b[i] * b[i]);
    before.push_back({before.back().first + a[i] * a[i], before.back().second + b[i] * b[i]});
  }
  const std::size_t n = difference.size();
  if (n < 2) return {kUnknown, kUnknown, kUnknown, 0};
  const double alike = static_cast<double>(n) / effective_samples(difference);
  const std::size_t block = std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(2 * alike)), 1, n);
  const std::size_t blocks = (n + block - 1) / block;
  const auto [all_a, all_b] = before.back();
  boost::random::uniform_int_distribution<std::size_t> start(0, n - 1);
  return interval(std::sqrt(all_a / all_b), block, seed, [&](auto& random) {
    double sum_a = 0, sum_b = 0;
    for (std::size_t i = 0; i < blocks; ++i) {
      const std::size_t first = start(random), last = first + block;
      const std::size_t wrapped = last > n ? last - n : 0;
      sum_a += before[std::min(last, n)].first - before[first].first + before[wrapped].first;
      sum_b += before[std::min(last, n)].second - before[first].second + before[wrapped].second;
    }
    return std::sqrt(sum_a / sum_b);
  });
}

PairedRatio paired_ratio_of_runs(std::span<const std::pair<double, double>> squares, std::uint64_t seed) {
  if (squares.size() < 2) return {kUnknown, kUnknown, kUnknown, 0};
  double all_a = 0, all_b = 0;
  for (const auto& [a, b] : squares) all_a += a, all_b += b;
  boost::random::uniform_int_distribution<std::size_t> run(0, squares.size() - 1);
  return interval(std::sqrt(all_a / all_b), 1, seed, [&](auto& random) {
    double sum_a = 0, sum_b = 0;
    for (std::size_t i = 0; i < squares.size(); ++i) {
      const auto& [a, b] = squares[run(random)];
      sum_a += a, sum_b += b;
    }
    return std::sqrt(sum_a / sum_b);
  });
}

}  // namespace halyard

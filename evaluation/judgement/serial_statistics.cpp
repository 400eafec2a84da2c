#include "evaluation/judgement/serial_statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <limits>
#include <unsupported/Eigen/FFT>

#include "model/statistics/distributions.h"

namespace halyard {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

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

/// ρ of all lags.
std::vector<double> all_correlations(const Centered& c) {
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<double> padded = c.x, rho;
  padded.resize(std::bit_ceil(2 * c.x.size()));  // so that the ends of the series do not meet
  std::vector<std::complex<double>> spectrum;
  fft.fwd(spectrum, padded);
  for (std::complex<double>& line : spectrum) line = std::norm(line);
  fft.inv(rho, spectrum, static_cast<Eigen::Index>(padded.size()));
  rho.resize(c.x.size());
  for (double& r : rho) r /= c.squares;
  return rho;
}

/// Appends ρ of the lags from rho.size() up to at least `lags`. A few are summed side by side, because each sum alone
/// waits for its last addition; many are computed at once.
void append_correlations(const Centered& c, std::size_t lags, std::vector<double>& rho) {
  constexpr std::size_t kTogether = 8, kFew = 256;
  const std::size_t n = c.x.size();
  if (lags > kFew && rho.size() <= lags && lags < n && c.squares > 0) {
    rho = all_correlations(c);
    return;
  }
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

/// The root of the ratio of the sum of the first numbers to that of the second, with its interval.
PairedRatio jackknifed(std::span<const std::pair<double, double>> squares, std::size_t block) {
  const auto n = static_cast<double>(squares.size());
  double a = 0, b = 0;
  for (const auto& [of_a, of_b] : squares) a += of_a, b += of_b;
  double mean = 0, deviations = 0;
  std::vector<double> without;
  for (const auto& [of_a, of_b] : squares) {
    without.push_back(std::log((a - of_a) / (b - of_b)));
    mean += without.back() / n;
  }
  for (const double l : without) deviations += (l - mean) * (l - mean);
  const double half_width = t_quantile(n - 1, 0.025) * std::sqrt((n - 1) / n * deviations);
  PairedRatio r{std::sqrt(a / b), 0, std::numeric_limits<double>::infinity(), block};
  if (std::isfinite(half_width))
    r.lower = r.ratio * std::exp(-half_width / 2), r.upper = r.ratio * std::exp(half_width / 2);
  return r;
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

PairedRatio paired_ratio(std::span<const double> a, std::span<const double> b) {
  std::vector<std::pair<double, double>> squares;
  double of_a = 0, of_b = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    squares.push_back({a[i] * a[i], b[i] * b[i]});
    of_a += squares.back().first, of_b += squares.back().second;
  }
  const std::size_t n = squares.size();
  if (n < 2) return {kUnknown, kUnknown, kUnknown, 0};
  std::vector<double> linear;
  for (const auto& [square_a, square_b] : squares) linear.push_back(square_a / of_a - square_b / of_b);
  constexpr double kSamplesOfABlock = 6;
  constexpr std::size_t kFewestBlocks = 4;
  const auto independent = static_cast<std::size_t>(effective_samples(linear) / kSamplesOfABlock);
  const std::size_t blocks = std::min(n, std::max(kFewestBlocks, independent));
  std::vector<std::pair<double, double>> sums(blocks);
  for (std::size_t i = 0; i < n; ++i) {
    auto& [sum_a, sum_b] = sums[i * blocks / n];
    sum_a += squares[i].first, sum_b += squares[i].second;
  }
  return jackknifed(sums, n / blocks);
}

PairedRatio paired_ratio_of_runs(std::span<const std::pair<double, double>> squares) {
  if (squares.size() < 2) return {kUnknown, kUnknown, kUnknown, 0};
  return jackknifed(squares, 1);
}

}  // namespace halyard

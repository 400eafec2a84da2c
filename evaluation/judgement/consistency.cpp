#include "evaluation/judgement/consistency.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/statistics/distributions.h"

namespace halyard {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kLags = 20;

Consistency banded(double mean, double samples, double readings) {
  const auto [lower, upper] = chi_square_band(readings * samples);
  return {mean, lower, upper, samples, readings};
}

}  // namespace

Confidence Consistency::confidence() const {
  if (std::isnan(mean)) return Confidence::unstated;
  return mean > upper ? Confidence::overconfident : mean < lower ? Confidence::underconfident : Confidence::consistent;
}

Consistency consistency(std::span<const double> squares, double readings) {
  double sum = 0, count = 0;
  for (const double s : squares)
    if (!std::isnan(s)) sum += s, count += 1;
  if (count == 0) return {kNan, kNan, kNan, 0};
  return banded(sum / count, effective_samples(squares), readings);
}

Consistency consistency_of_runs(std::span<const Consistency> runs) {
  double sum = 0, count = 0, samples = 0, readings = 0;
  for (const Consistency& run : runs)
    if (!std::isnan(run.mean))
      sum += run.mean, count += 1, samples += run.samples, readings += run.readings * run.samples;
  if (count == 0) return {kNan, kNan, kNan, 0};
  return banded(sum / count, samples, readings / samples);
}

bool Whiteness::is_white() const { return std::abs(correlation) <= chance && std::abs(with_torque) <= chance; }

Whiteness whiteness(std::span<const double> innovation, std::span<const double> torque) {
  std::vector<double> own, others;
  for (std::size_t i = 0; i < innovation.size(); ++i) {
    if (std::isnan(innovation[i])) continue;
    own.push_back(innovation[i]);
    if (torque.size() == innovation.size()) others.push_back(torque[i]);
  }
  if (own.size() < 2 * kLags) return {kNan, kNan, kNan};
  const auto correlation = [&](std::span<const double> with, std::size_t lag, bool centred) {
    double mean = 0, n = 0;
    for (std::size_t i = lag; centred && i < own.size(); ++i)
      if (!std::isnan(with[i - lag])) mean += with[i - lag], n += 1;
    mean = n > 0 ? mean / n : 0;
    double of_own = 0, of_other = 0, both = 0;
    for (std::size_t i = lag; i < own.size(); ++i) {
      const double a = own[i], b = with[i - lag] - mean;
      if (!std::isnan(b)) of_own += a * a, of_other += b * b, both += a * b;
    }
    return of_own > 0 && of_other > 0 ? both / std::sqrt(of_own * of_other) : 0;
  };
  Whiteness w;
  w.correlation = correlation(own, 1, false);
  for (std::size_t lag = 1; lag <= kLags && !others.empty(); ++lag) {
    const double c = correlation(others, lag, true);
    if (std::abs(c) > std::abs(w.with_torque)) w.with_torque = c;
  }
  w.chance = normal_quantile(1 - 0.025 / (2 * kLags)) / std::sqrt(static_cast<double>(own.size()));
  return w;
}

std::vector<double> normalised_squares(std::span<const double> estimate, std::span<const double> truth,
                                       std::span<const double> std_deviation) {
  std::vector<double> squares;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const double z = std_deviation[i] > 0 ? (estimate[i] - truth[i]) / std_deviation[i] : kNan;
    squares.push_back(z * z);
  }
  return squares;
}

std::string in_words(const Consistency& c) {
  const std::string off = fmt::format("errors are {:.3g} times what it says", std::sqrt(c.mean));
  switch (c.confidence()) {
    case Confidence::unstated: break;
    case Confidence::consistent: return "consistent";
    case Confidence::overconfident: return "too sure: " + off;
    case Confidence::underconfident: return "too cautious: " + off;
  }
  return "says nothing of its errors";
}

std::string in_words(const Whiteness& w) {
  if (std::isnan(w.correlation)) return "-";
  if (w.is_white()) return "white";
  const bool neighbours = std::abs(w.correlation) > w.chance;
  return fmt::format("{}{}{}", neighbours ? fmt::format("neighbours correlate, {:.2f}", w.correlation) : "",
                     neighbours && std::abs(w.with_torque) > w.chance ? "; " : "",
                     std::abs(w.with_torque) > w.chance ? fmt::format("with the torque, {:.2f}", w.with_torque) : "");
}

}  // namespace halyard

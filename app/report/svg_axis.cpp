#include "app/report/svg_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace halyard::report {
namespace {

constexpr double kMostTicks = 6, kRounding = 1e-9;

/// The step of 1, 2 or 5 times a power of ten that gives at most so many.
double even_step(double range) {
  const double rough = range / kMostTicks, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * power >= rough * (1 - kRounding)) return step * power;
  return 10 * power;
}

std::vector<double> even_ticks(double from, double to) {
  std::vector<double> ticks;
  const double step = even_step(to - from);
  for (double i = std::ceil(from / step - kRounding); i * step <= to + kRounding * step; ++i)
    ticks.push_back(i * step + 0.0);  // 0 without a sign
  return ticks;
}

}  // namespace

SvgAxis::SvgAxis(std::span<const double> numbers, bool is_logarithmic, bool rounded) : is_logarithmic_(is_logarithmic) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const double number : numbers) {
    const double x = is_logarithmic_ ? std::log10(number) : number;
    if (!std::isfinite(x)) continue;
    least = std::min(least, x);
    greatest = std::max(greatest, x);
  }
  if (least > greatest) return;
  from_ = least, to_ = greatest;
  // Numbers that differ by roundings alone have no room for ticks between them.
  constexpr double kLeastRange = 1e-9;
  if (to_ - from_ <= kLeastRange * std::max(std::abs(from_), std::abs(to_))) {
    const double room = is_logarithmic_ ? 0.5 : std::abs(from_) / 2;
    from_ -= room, to_ += from_ == 0 && !is_logarithmic_ ? 1 : room;
  }
  if (!rounded) return;
  const double step = is_logarithmic_ ? 0.25 : even_step(to_ - from_);
  from_ = step * std::floor(from_ / step + kRounding);
  to_ = step * std::ceil(to_ / step - kRounding);
}

double SvgAxis::place(double number) const {
  const double x = is_logarithmic_ ? std::log10(number) : number;
  return std::isfinite(x) ? (x - from_) / (to_ - from_) : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> SvgAxis::ticks() const {
  if (!is_logarithmic_) return even_ticks(from_, to_);
  std::vector<double> ticks;
  const double range = to_ - from_;
  const std::vector<double> multiples = range <= 1.2   ? std::vector<double>{1, 2, 5}
                                        : range <= 2.2 ? std::vector<double>{1, 3}
                                                       : std::vector<double>{1};
  const double stride = std::ceil(range / kMostTicks);
  for (double power = std::floor(from_); power <= to_ + kRounding; ++power)
    for (const double multiple : multiples) {
      const double place = power + std::log10(multiple);
      const bool is_within = place >= from_ - kRounding && place <= to_ + kRounding;
      if (is_within && std::fmod(std::abs(power), stride) == 0) ticks.push_back(multiple * std::pow(10, power));
    }
  return ticks.size() < 2 ? even_ticks(std::pow(10, from_), std::pow(10, to_)) : ticks;
}

}  // namespace halyard::report

#include "diagnosis/leaps.h"

#include <algorithm>
#include <cmath>

namespace halyard {
namespace {

constexpr std::size_t kStrongest = 4;   ///< leaps that are followed
constexpr double kApart = 0.15;         ///< s; closer ones are one leap, smeared by the comparing kernel
constexpr double kAround = 1.5;         ///< rows before and after a leap

struct Leap { double strength, from, to; };

/// Of one channel.
std::vector<Leap> leaps_of(const std::vector<double>& time, const std::vector<double>& residual) {
  std::vector<Leap> all;
  std::vector<double> gap, size;
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (!(time[i] > time[i - 1])) continue;   // the next record
    all.push_back({std::abs(residual[i] - residual[i - 1]), time[i - 1], time[i]});
    gap.push_back(time[i] - time[i - 1]);
    size.push_back(all.back().strength);
  }
  if (all.empty()) return all;
  const auto middle = static_cast<std::ptrdiff_t>(all.size() / 2);
  std::ranges::nth_element(gap, gap.begin() + middle);
  std::ranges::nth_element(size, size.begin() + middle);
  if (!(size[middle] > 0)) return {};
  for (Leap& l : all) l.strength /= size[middle] * std::sqrt((l.to - l.from) / gap[middle]);
  return all;
}

}  // namespace

std::vector<double> leaps(const Evidence& evidence, const std::vector<double>& rows) {
  std::vector<Leap> all;
  double row = 0;
  for (int c = 0; c < evidence.channels(); ++c) {
    std::vector<double> time, residual;
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (evidence.row_channel()[r] == c) time.push_back(evidence.row_time()[r]), residual.push_back(rows[r]);
    for (const Leap& l : leaps_of(time, residual)) all.push_back(l);
  }
  std::ranges::stable_sort(all, std::ranges::greater{}, &Leap::strength);
  for (const Leap& l : all) row = row > 0 ? std::min(row, l.to - l.from) : l.to - l.from;

  std::vector<Leap> strongest;
  for (const Leap& l : all) {
    const auto near = [&](const Leap& s) { return l.from < s.to + kApart && l.to > s.from - kApart; };
    if (strongest.size() < kStrongest && std::ranges::none_of(strongest, near)) strongest.push_back(l);
  }
  std::vector<double> instants;
  for (const Leap& l : strongest) {
    const double first = l.from - kAround * row, last = l.to + kAround * row;
    const int steps = static_cast<int>(std::ceil((last - first) / row));
    for (int i = 0; i <= steps; ++i) instants.push_back(std::lerp(first, last, static_cast<double>(i) / steps));
  }
  std::ranges::sort(instants);
  return instants;
}

}  // namespace halyard

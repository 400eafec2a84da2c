#include "diagnosis/starts/leaps.h"

#include <algorithm>
#include <cmath>

#include "model/statistics/quantile.h"

namespace halyard {
namespace {

constexpr std::size_t kStrongest = 4;  ///< leaps that are followed
constexpr double kApart = 0.15;        ///< s; closer ones are one leap, smeared by the comparing kernel
constexpr double kAround = 1.5;        ///< rows before and after a leap
constexpr double kLongest = 1.5;       ///< s; what happened in a longer gap between rows cannot be told
constexpr int kMostInstants = 24;      ///< of one leap

struct Leap {
  double strength, from, to;
};

/// Of channel c.
std::vector<Leap> leaps_of(const Evidence& evidence, int c, const std::vector<double>& rows) {
  std::vector<std::size_t> own;
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (evidence.row_channel()[r] == c) own.push_back(r);
  std::vector<Leap> all;
  std::vector<double> gap, size;
  for (std::size_t i = 1; i < own.size(); ++i) {
    const std::size_t before = own[i - 1], r = own[i];
    const double from = evidence.row_time()[before], to = evidence.row_time()[r];
    if (evidence.row_record()[before] != evidence.row_record()[r] || to - from > kLongest) continue;
    all.push_back({std::abs(rows[r] - rows[before]), from, to});
    gap.push_back(to - from);
    size.push_back(all.back().strength);
  }
  if (all.empty()) return all;
  const double usual_gap = median(std::move(gap)), usual_size = median(std::move(size));
  if (!(usual_size > 0)) return {};
  for (Leap& l : all) l.strength /= usual_size * std::sqrt((l.to - l.from) / usual_gap);
  return all;
}

}  // namespace

std::vector<double> leaps(const Evidence& evidence, const std::vector<double>& rows) {
  std::vector<Leap> all;
  double row = 0;
  for (int c = 0; c < evidence.channels(); ++c)
    for (const Leap& l : leaps_of(evidence, c, rows)) all.push_back(l);
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
    const int steps = std::min(kMostInstants - 1, static_cast<int>(std::ceil((last - first) / row)));
    for (int i = 0; i <= steps; ++i) instants.push_back(std::lerp(first, last, static_cast<double>(i) / steps));
  }
  std::ranges::sort(instants);
  return instants;
}

}  // namespace halyard

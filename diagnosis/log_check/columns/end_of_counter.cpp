#include "diagnosis/log_check/columns/end_of_counter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/statistics/quantile.h"

namespace halyard {
namespace {

constexpr std::size_t kBeside = 3;  ///< samples at least over which a speed is measured
constexpr double kFewCounts = 20;

/// The smallest change from one sample to the next; their range if there is none.
double step_of_sensor(const Samples& s) {
  const auto [low, high] = std::ranges::minmax(s.x);
  double count = high - low;
  for (std::size_t i = 1; i < s.size(); ++i)
    if (s.x[i] != s.x[i - 1]) count = std::min(count, std::abs(s.x[i] - s.x[i - 1]));
  return count;
}

/// The median of |x(t + T/2) - 2 x(t) + x(t - T/2)| where the position moves. half: T/2 in samples.
double usual_turn(const Samples& s, std::size_t half) {
  std::vector<double> turns;
  for (std::size_t i = half; i + half < s.size(); ++i)
    if (const double turn = std::abs(s.x[i + half] - 2 * s.x[i] + s.x[i - half]); turn > 0) turns.push_back(turn);
  return turns.empty() ? 0 : median(std::move(turns));
}

/// Speed towards or from a stop, per sample, if the position did not slow down beside it; 0 if it did.
///
/// at: the sample beside the stop. back: -1 before the stop, 1 after it. longest: samples over which a speed may be
/// measured at most.
double undiminished_speed(const Samples& s, std::size_t at, int back, std::size_t longest, double count) {
  constexpr double kCounts = 5;  // that a speed is measured from
  const auto way = [&](std::size_t from, std::size_t samples) {
    const auto i = static_cast<std::ptrdiff_t>(at) + back * static_cast<std::ptrdiff_t>(from);
    const std::ptrdiff_t j = i + back * static_cast<std::ptrdiff_t>(samples);
    return j < 0 || j >= static_cast<std::ptrdiff_t>(s.size()) ? 0 : std::abs(s.x[j] - s.x[i]);
  };
  for (std::size_t w = kBeside; w <= longest; ++w) {
    if (way(0, w) < kCounts * count) continue;
    const double speed = way(0, w) / static_cast<double>(w), farther = way(w, 2 * w) / static_cast<double>(2 * w);
    return speed > 0.5 * farther ? speed : 0;
  }
  return 0;
}

/// The second rule of the header.
bool is_cut_off(const Samples& s, const Run& run, double count) {
  const std::size_t longest = std::max(kBeside, run.size() / 8);
  if (run.begin == 0 || run.end == s.size()) return false;
  const double speed = std::min(undiminished_speed(s, run.begin - 1, -1, longest, count),
                                undiminished_speed(s, run.end, 1, longest, count));
  const double beyond = speed * static_cast<double>(run.size()) / 4;
  return beyond > kFewCounts * count && 2 * beyond > 0.25 * usual_turn(s, run.size() / 2);
}

}  // namespace

void check_end_of_counter(LogUnderCheck& c, const PositionColumn& column) {
  const Samples s(c.log, (c.log.*column.signal)[column.k]);
  // A frozen sensor is told already.
  if (s.size() < 20 || c.has_finding(column.name())) return;
  std::vector<double> steps;
  for (std::size_t i = 3; i < s.size(); ++i) steps.push_back(std::abs(s.x[i] - s.x[i - 3]));
  const double usual = quantile(steps, 0.9);
  const std::vector<Run> runs = runs_of(s.x);
  const double held = std::max(10.0, 5 * usual_length(runs));
  const auto [low, high] = std::ranges::minmax(s.x);
  // A joint that is held steps to and fro between a few counts, or drifts a little, and ends at one of them.
  const double count = step_of_sensor(s);
  if (high - low < std::max(kFewCounts * count, column.significant)) return;
  for (const double end : {low, high}) {
    std::size_t abrupt = 0, all = 0;
    double time = 0;
    for (const Run& run : runs) {
      if (s.x[run.begin] != end || static_cast<double>(run.size()) < held || run.begin < 4 || run.end + 4 > s.size())
        continue;
      ++all;
      time += s.time[run.end - 1] - s.time[run.begin];
      const double before = std::abs(s.x[run.begin] - s.x[run.begin - 4]), after = std::abs(s.x[run.end + 3] - end);
      if (std::min(before, after) > 0.5 * usual || (column.signal == &Log::motor_position && is_cut_off(s, run, count)))
        ++abrupt;
    }
    if (abrupt >= 2 && 2 * abrupt > all)
      c.suspect(column.name(),
                fmt::format("stops abruptly at its extreme value {:.6g} {} times, for {:.3g} s together: a counter or "
                            "converter at its end",
                            end, all, time),
                leave_out(column));
  }
}

}  // namespace halyard

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/clock_check.h"
#include "diagnosis/log_check/robust.h"

namespace halyard {
namespace {

std::vector<double> intervals(const std::vector<double>& time) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  return steps;
}

/// False if some time does not increase.
bool check_order(LogUnderCheck& c, const std::vector<double>& steps) {
  const auto bad = std::ranges::find_if(steps, [](double step) { return !(step > 0); });
  if (bad == steps.end()) return true;
  const auto count = std::ranges::count_if(steps, [](double step) { return !(step > 0); });
  const std::size_t row = static_cast<std::size_t>(bad - steps.begin()) + 1;
  c.reject("time",
           fmt::format("{:.6g} s follows {:.6g} s in sample {}, the first of {} times that do not increase",
                       c.log.time[row], c.log.time[row - 1], row + 1, count),
           "sort the rows, remove repeated ones, and split a log whose clock was set back");
  return false;
}

/// False if the sample rate is implausible.
bool check_unit(LogUnderCheck& c, double step) {
  const double slowest = 1 / c.rule.slowest_hz, fastest = 1 / c.rule.fastest_hz;
  if (step > fastest && step <= slowest * (1 + 1e-6)) return true;
  constexpr double kShortestLog = 1;  // s
  const auto is_plausible = [&](double factor) {
    return step * factor > fastest && step * factor <= slowest && c.log.duration() * factor > kShortestLog;
  };
  std::string units, remedy = "give the times in s, or a record with at least 10 samples a second";
  for (const auto& [factor, name] : {std::pair(1e-3, "milliseconds"), std::pair(1e-6, "microseconds")}) {
    if (!is_plausible(factor)) continue;
    if (units.empty()) remedy = "read it with " + c.option("time", Correction{.factor = factor});
    units += (units.empty() ? "; it looks like a time in " : " or ") + std::string(name);
  }
  c.reject("time",
           fmt::format("a sample follows another after {:.4g} s; expected at least {:g} and at most {:g} samples a "
                       "second{}",
                       step, c.rule.slowest_hz, c.rule.fastest_hz, units),
           remedy);
  return false;
}

/// Rows that are missing in interval i. A row that is written late or early makes an interval long, too, but the
/// intervals beside it as much shorter.
double missing_rows(const std::vector<double>& steps, std::size_t i, double step) {
  constexpr std::size_t kBeside = 3;
  const auto rows_in = [&](double seconds) { return std::round(seconds / step); };
  double missing = rows_in(steps[i]) - 1;
  if (missing <= 0) return 0;
  for (std::size_t first = i - std::min(i, kBeside); first <= i; ++first) {
    double together = std::accumulate(&steps[first], &steps[i], 0.0);
    for (std::size_t last = i; last < std::min(i + kBeside + 1, steps.size()); ++last) {
      together += steps[last];
      missing = std::min(missing, rows_in(together) - static_cast<double>(last - first + 1));
    }
  }
  return std::max(0.0, missing);
}

void check_regularity(LogUnderCheck& c, const std::vector<double>& steps, double step) {
  double missing = 0, longest = 0, gaps = 0;
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (const double rows = missing_rows(steps, i, step); rows > 0)
      missing += rows, gaps += 1, longest = std::max(longest, steps[i]);
  const auto rows = static_cast<double>(steps.size());
  if (missing > c.rule.missing * rows)
    c.suspect(
        "time",
        fmt::format("{:g} rows are missing in {:g} gaps, the longest of {:.3g} s, beside {} samples every {:.4g} s",
                    missing, gaps, longest, steps.size() + 1, step),
        "record without losses; gaps longer than 0.05 s split the log");
  std::vector<double> between;
  for (const double s : steps)
    if (s <= c.rule.gap * step) between.push_back(s);
  const double width = quantile(between, 0.95) - quantile(between, 0.05);
  if (width > c.rule.jitter * step)
    c.suspect("time",
              fmt::format("the sample interval jitters: {:.4g} s in the median, 90 % of them within {:.4g} to {:.4g} s",
                          step, quantile(between, 0.05), quantile(between, 0.95)),
              "record the time at which each sample was taken, not the time at which it was written");
}

}  // namespace

void check_clock(LogUnderCheck& c) {
  const std::vector<double> steps = intervals(c.log.time);
  if (steps.empty())
    return c.reject("time", fmt::format("has {} samples; expected a motion", c.log.size()), "record at least 2 s");
  if (!check_order(c, steps)) return;
  const double step = median(steps);
  if (!check_unit(c, step)) return;
  check_regularity(c, steps, step);
}

std::vector<LogFinding> check_times(const Log& log, const ArmModel& model, const ColumnMap& columns) {
  if (log.size() < 2) return {};
  Log clock(log.n_joints);
  clock.source = log.source;
  clock.time = log.time;
  const LogCheckRule rule;
  LogUnderCheck c(clock, model, columns, rule);
  check_clock(c);
  return c.findings;
}

}  // namespace halyard

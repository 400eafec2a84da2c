#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/clock_check.h"
#include "diagnosis/record/record.h"
#include "diagnosis/record/settling.h"
#include "model/statistics/quantile.h"

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

struct TimeUnit {
  double seconds;
  const char* name;
};
constexpr TimeUnit kMinutes = {60, "minutes"};

/// The option that reads the times in a unit.
std::string option_of(const LogUnderCheck& c, const TimeUnit& unit) {
  return c.option("time", Correction{.factor = unit.seconds});
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
  for (const TimeUnit& unit :
       {TimeUnit{1e-3, "milliseconds"}, TimeUnit{1e-6, "microseconds"}, TimeUnit{1e-9, "nanoseconds"}, kMinutes}) {
    if (!is_plausible(unit.seconds)) continue;
    if (units.empty()) remedy = "read it with " + option_of(c, unit);
    units += (units.empty() ? "; it looks like a time in " : " or ") + std::string(unit.name);
  }
  c.reject("time",
           fmt::format("a sample follows another after {:.4g} s; expected at least {:g} and at most {:g} samples a "
                       "second{}",
                       step, c.rule.slowest_hz, c.rule.fastest_hz, units),
           remedy);
  return false;
}

/// A log that is shorter than any record, or has more samples a second than a controller takes: its time may be in
/// minutes. Gross if it is both, and minutes explain both.
void check_duration(LogUnderCheck& c, double step) {
  const RecordOptions record;
  const double shortest = 1 + settling_time(c.model, record.settle_s), duration = c.log.duration();
  const bool is_short = duration < shortest, is_fast = step < 1 / c.rule.controller_hz;
  if (!is_short && !is_fast) return;
  const bool in_minutes = duration * kMinutes.seconds >= shortest && step * kMinutes.seconds <= 1 / c.rule.slowest_hz;
  const std::string expected =
      is_short ? fmt::format("expected at least {:.2g} s, the shortest record from which a diagnosis learns", shortest)
               : fmt::format("expected at most {:g} samples a second, as controllers take them", c.rule.controller_hz);
  const std::string what =
      fmt::format("{} samples in {:.4g} s, one after {:.4g} s; {}", c.log.size(), duration, step, expected);
  const std::string in_other_unit = "read it with " + option_of(c, kMinutes);
  if (is_short && is_fast && in_minutes)
    return c.reject("time", what + "; it looks like a time in minutes", in_other_unit);
  c.suspect("time", what,
            (is_short ? "give a longer record" : "nothing to do if the samples were taken so fast") +
                (in_minutes ? "; if the times are in minutes, " + in_other_unit : ""));
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
  if (check_unit(c, step)) check_regularity(c, steps, step);
}

void check_length(LogUnderCheck& c) {
  if (const std::vector<double> steps = intervals(c.log.time); !steps.empty()) check_duration(c, median(steps));
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

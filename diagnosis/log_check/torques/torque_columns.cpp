/// What single columns of torques show, whatever the motion requires.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/columns/column_samples.h"
#include "diagnosis/log_check/robust.h"
#include "model/statistics/quantile.h"

namespace halyard {
namespace {

void check_clipped_torque(LogUnderCheck& c, int k) {
  const Samples s(c.log, c.log.motor_torque[k]);
  const double limit = c.model.joints[k].controller.torque_limit, usual = 0.5 * spread(s.x);
  if (s.size() < 20 || usual == 0) return;
  const auto [low, high] = std::ranges::minmax(s.x);
  for (const double end : {low, high}) {
    const bool is_limit = limit > 0 && std::abs(std::abs(end) / limit - 1) < c.rule.at_limit;
    double held = 0;
    for (const Run& run : runs_of(s.x))
      if (s.x[run.begin] == end && run.size() >= 3) held += static_cast<double>(run.size());
    const double share = held / static_cast<double>(s.size());
    if (std::abs(end) > 0 && !is_limit && share > c.rule.clipped && share < 0.5 && std::abs(end) > 0.5 * usual)
      c.suspect(
          column_name(&Log::motor_torque, k),
          fmt::format("is exactly {:.6g} in {:.2g} % of the samples, its extreme value: clipped", end, 100 * share),
          "record the torque with a larger range; if the drive limits it, state the model's torque_limit");
  }
}

/// Whether a torque stays where a drive limits it, or where its range ends.
bool is_at_end(const LogUnderCheck& c, int k, double torque, double low, double high) {
  const double limit = c.model.joints[k].controller.torque_limit;
  return torque == low || torque == high || (limit > 0 && std::abs(std::abs(torque) / limit - 1) < c.rule.at_limit);
}

/// Motion of a motor that counts as such, rad. Where controllers of right logs hold a torque for more than 0.05 s, the
/// motor does not change by a single count.
double least_motion(const LogUnderCheck& c, int k) {
  const double range = c.range(k) / std::abs(c.joint_per_motor(k));
  return 0.01 * (range > 0 ? range : spread(c.log.motor_position[k]));
}

/// The rows in which a torque stays the same although its motor moves.
struct FrozenRows {
  std::size_t begin, end;
};

std::vector<FrozenRows> frozen_rows(const LogUnderCheck& c, int k, const Samples& s) {
  const std::vector<Run> runs = runs_of(s.x);
  const auto [low, high] = std::ranges::minmax(s.x);
  const double least = least_motion(c, k), shortest = low == high ? 0 : 5 * usual_length(runs);
  std::vector<FrozenRows> frozen;
  for (const Run& run : runs) {
    const double torque = s.x[run.begin], begin = s.time[run.begin], end = s.time[run.end - 1];
    // A torque of 0 was not recorded, or the drive was off.
    if (torque == 0 || end - begin < c.rule.independent_s || static_cast<double>(run.size()) < shortest) continue;
    if (low != high && is_at_end(c, k, torque, low, high)) continue;
    const auto first = std::ranges::lower_bound(c.log.time, begin), last = std::ranges::upper_bound(c.log.time, end);
    const FrozenRows rows = {static_cast<std::size_t>(first - c.log.time.begin()),
                             static_cast<std::size_t>(last - c.log.time.begin())};
    const std::vector<double>& motor = c.log.motor_position[k];
    if (spread({motor.begin() + static_cast<std::ptrdiff_t>(rows.begin),
                motor.begin() + static_cast<std::ptrdiff_t>(rows.end)}) > least)
      frozen.push_back(rows);
  }
  return frozen;
}

void check_frozen_torque(LogUnderCheck& c, int k) {
  std::vector<double>& torque = c.log.motor_torque[k];
  const Samples s(c.log, torque);
  if (s.size() < 20 || c.log.motor_position[k].empty()) return;
  const std::vector<FrozenRows> frozen = frozen_rows(c, k, s);
  if (frozen.empty()) return;
  const auto [low, high] = std::ranges::minmax(s.x);
  double all = 0, from = 0, to = 0;
  for (const auto& [begin, end] : frozen) {
    const double first = c.log.time[begin], last = c.log.time[end - 1];
    all += last - first;
    if (last - first > to - from) from = first, to = last;
    std::fill(torque.begin() + static_cast<std::ptrdiff_t>(begin), torque.begin() + static_cast<std::ptrdiff_t>(end),
              std::numeric_limits<double>::quiet_NaN());
  }
  const std::string name = column_name(&Log::motor_torque, k);
  const std::string what =
      low == high ? fmt::format("is exactly {:.6g} N m all the time, while its motor moves", low)
                  : fmt::format("stays the same for {:.3g} s while its motor moves, longest from {:.4g} to {:.4g} s",
                                all, from, to);
  c.suspect(name, what + "; expected a torque that changes with the motion",
            fmt::format("if this was not the command, {}read the log without this torque with --column {}=: check and "
                        "diagnose do without it",
                        low == high ? "" : "leave these cells empty, or ", name));
}

}  // namespace

void check_torque_spikes(LogUnderCheck& c) {
  for (int k = 0; k < c.n(); ++k) {
    std::vector<double>& torque = c.log.motor_torque[k];
    std::vector<double> size;
    for (const double x : torque)
      if (std::abs(x) > 0) size.push_back(std::abs(x));
    const double usual = quantile(size, 0.95), limit = c.rule.torque_spike * usual;
    const auto is_spike = [limit](double x) { return std::abs(x) > limit; };
    const auto first = std::ranges::find_if(torque, is_spike);
    if (first == torque.end()) continue;
    const auto row = static_cast<std::size_t>(first - torque.begin());
    const auto others = std::count_if(first + 1, torque.end(), is_spike);
    c.reject(column_name(&Log::motor_torque, k),
             fmt::format("{:g} N m at {:.6g} s{}; 95 % of the torques are below {:.3g} N m", *first, c.log.time[row],
                         others > 0 ? fmt::format(" (and {} more)", others) : "", usual),
             "correct this cell, or leave it empty");
    c.findings.back().line = line_of_sample(c.log, row);
    std::ranges::replace_if(torque, is_spike, std::numeric_limits<double>::quiet_NaN());
  }
}

void check_frozen_torques(LogUnderCheck& c) {
  for (int k = 0; k < c.n(); ++k)
    if (c.is_driven(k)) check_frozen_torque(c, k);
}

void check_clipped_torques(LogUnderCheck& c) {
  for (int k = 0; k < c.n(); ++k)
    if (c.is_driven(k)) check_clipped_torque(c, k);
}

}  // namespace halyard

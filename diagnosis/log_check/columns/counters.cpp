/// Counters that start again, and an arm that stands still.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/columns/column_samples.h"
#include "diagnosis/log_check/robust.h"
#include "diagnosis/record/sampled_column.h"

namespace halyard {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// A period after which a reading starts again; 0: none.
struct Period {
  double size = 0;
  std::string what = {};
};

Period of_turns(double turns) { return {turns * kTurn, fmt::format("{:g} turn{}", turns, turns > 1 ? "s" : "")}; }

/// Of the counters of its encoder.
std::vector<Period> counters_of(const PositionColumn& column) {
  std::vector<Period> counters;
  if (column.resolution <= 0) return counters;
  for (const int bits : {10, 12, 13, 14, 15, 16, 17, 18, 20, 24, 32})
    counters.push_back({std::pow(2, bits) * column.resolution, fmt::format("2^{} counts of its encoder", bits)});
  return counters;
}

/// The period of a counter that jumps so.
Period period_of(const Jumps& jumps, const PositionColumn& column) {
  const double step = std::abs(jumps.step);
  const double tolerance = std::clamp(2 * jumps.usual, 0.02 * kTurn, 0.1 * kTurn);
  const double turns = std::round(step / kTurn);
  if (column.turns && jumps.alike && turns >= 1 && std::abs(step - turns * kTurn) < tolerance) return of_turns(turns);
  // A single jump may have any size by chance.
  if (jumps.count < 2 || !jumps.alike) return {};
  for (const Period& counter : counters_of(column))
    if (std::abs(step / counter.size - 1) < 0.02) return counter;
  return {};
}

/// The steps of more than half a period, of either sign, that the next few readings do not take back. longest: time
/// that a step may take, s.
bool has_lasting_laps(const Samples& s, double period, double longest) {
  constexpr std::size_t kReturns = 3;   // readings within which a lost bit is right again
  constexpr std::size_t kFewLost = 10;  // a reading that rests at the end of its period goes to and fro more often
  std::size_t lasting = 0, lost = 0;
  for (std::size_t i = 1; i < s.size(); ++i) {
    const double step = s.x[i] - s.x[i - 1];
    if (std::abs(step) <= period / 2 || s.time[i] - s.time[i - 1] >= longest) continue;
    std::size_t back = i + 1;
    const std::size_t end = std::min(s.size(), i + 1 + kReturns);
    while (back < end && !((s.x[back] - s.x[back - 1]) * step < 0 && std::abs(s.x[back] - s.x[back - 1]) > period / 2))
      ++back;
    if (back < end) ++lost, i = back;
    else ++lasting;
  }
  return lasting > 0 || lost > kFewLost;
}

/// Whether a reading runs through a period again and again: it stays within one period, and a step of nearly a period
/// is a usual step once the period is taken off. longest: time that a step may take, s.
bool runs_in_laps(const Samples& s, double period, double longest) {
  if (spread(s.x) > (1 + 1e-6) * period) return false;
  double largest = 0, largest_at_end = 0;
  for (std::size_t i = 1; i < s.size(); ++i) {
    if (s.time[i] - s.time[i - 1] >= longest) continue;
    const double step = std::abs(s.x[i] - s.x[i - 1]);
    if (step > period / 2) largest_at_end = std::max(largest_at_end, period - step);
    else largest = std::max(largest, step);
  }
  return largest_at_end > 0 && largest_at_end < 2 * largest && largest < period / 4 &&
         has_lasting_laps(s, period, longest);
}

/// Jumps of a slow column stand out from its motion. A motor that turns fast jumps so often that they do not.
Period period_of(const Samples& s, const PositionColumn& column, double longest) {
  std::vector<Period> all = counters_of(column);
  if (column.turns) all.insert(all.begin(), of_turns(1));
  const auto found = std::ranges::find_if(all, [&](const Period& p) { return runs_in_laps(s, p.size, longest); });
  return found == all.end() ? Period{} : *found;
}

void check_wraps(LogUnderCheck& c, const PositionColumn& column) {
  const std::string name = column.name();
  const auto reject = [&](const std::string& what, const Period& period) {
    c.reject(name, what + "; expected a continuous position", "unwrap it with " + c.wrap_option(name, period.size));
  };
  const std::vector<double>& readings = (c.log.*column.signal)[column.k];
  const double longest = c.rule.lap_within * SampledColumn(c.log.time, readings).interval();
  if (const Period period = period_of(Samples(c.log, readings), column, longest); period.size > 0)
    return reject("starts again after " + period.what, period);
  const Jumps jumps = jumps_of(c, column);
  if (const Period period = period_of(jumps, column); jumps.count > 0 && period.size > 0)
    reject(jumps.description() + ", which is " + period.what, period);
}

void check_idle(LogUnderCheck& c) {
  bool moves = false, torque = false;
  std::string first;  // column of the first motor
  for (int k = 0; k < c.n(); ++k) {
    if (!c.is_driven(k)) continue;
    if (first.empty()) first = column_name(&Log::motor_position, k);
    const JointParameters<double>& j = c.model.nominal.joint[k];
    const double unmoved = std::max(3 * j.motor_encoder_resolution, 6 * j.motor_encoder_noise);
    const double least = std::max(unmoved, 1e-4 * c.range(k) / std::abs(c.joint_per_motor(k)));
    moves = moves || spread(c.log.motor_position[k]) > least;
    torque = torque || std::ranges::any_of(c.log.motor_torque[k], [](double t) { return std::isfinite(t) && t != 0; });
  }
  if (first.empty() || moves) return;
  c.reject(
      first,
      torque ? "torque is commanded and no motor moves: there is nothing to learn from; expected a motion"
             : "no motor moves and no torque is commanded, as of a robot that is switched off: there is nothing to "
               "learn from; expected a motion",
      "give a record in which the motors move; if they did, give the columns of their encoders, such as --column " +
          first + "=NAME");
  c.findings.back().stands_still = true;
}

}  // namespace

void check_counters(LogUnderCheck& c) {
  for (const PositionColumn& column : position_columns(c)) check_wraps(c, column);
  if (!c.has_gross()) check_idle(c);
}

}  // namespace halyard

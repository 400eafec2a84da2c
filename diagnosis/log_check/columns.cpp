#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/robust.h"
#include "diagnosis/record/record.h"
#include "diagnosis/record/sampled_column.h"

namespace halyard {
namespace {

constexpr double kShortestFreeze = 0.05;  ///< s; slow sensors hold a reading for 33 ms
constexpr const char* kLeaveEmpty = "leave these cells empty, or leave the column out";

/// The samples that a column has.
struct Samples {
  std::vector<double> time, x;
  Samples(const Log& log, const std::vector<double>& column) {
    for (std::size_t i = 0; i < column.size(); ++i)
      if (std::isfinite(column[i])) time.push_back(log.time[i]), x.push_back(column[i]);
  }
  std::size_t size() const { return x.size(); }
};

/// Samples begin..end-1 that are equal.
struct Run {
  std::size_t begin, end;
  std::size_t size() const { return end - begin; }
};

std::vector<Run> runs_of(const std::vector<double>& x) {
  std::vector<Run> runs;
  for (std::size_t begin = 0, end = 0; begin < x.size(); begin = end) {
    for (end = begin + 1; end < x.size() && x[end] == x[begin];) ++end;
    runs.push_back({begin, end});
  }
  return runs;
}

/// Samples for which a reading usually keeps its value: a slow sensor repeats the last one.
double usual_length(const std::vector<Run>& runs) {
  std::vector<double> lengths;
  for (const Run& run : runs) lengths.push_back(static_cast<double>(run.size()));
  // A column that hardly changes has no usual length: at most a twentieth of it.
  return std::min(median(lengths), static_cast<double>(runs.back().end) / 20);
}

struct PositionColumn {
  Signals Log::*signal;
  int k;
  double resolution;
  double significant;  ///< motion that counts as such, unit of the column
  bool turns;          ///< an angle
};

std::vector<PositionColumn> position_columns(const LogUnderCheck& c) {
  std::vector<PositionColumn> columns;
  for (int k = 0; k < c.n(); ++k) {
    const JointParameters<double>& j = c.model.nominal.joint[k];
    const double least = c.rule.least_motion * c.range(k);
    if (c.is_driven(k) && !c.log.motor_position[k].empty())
      columns.push_back(
          {&Log::motor_position, k, j.motor_encoder_resolution, least / std::abs(c.joint_per_motor(k)), true});
    if (!c.log.joint_position[k].empty())
      columns.push_back({&Log::joint_position, k, j.joint_encoder_resolution, least, j.type == JointType::revolute});
  }
  return columns;
}

/// Steps between two samples that no motion explains and that stay.
struct Jumps {
  std::size_t count = 0;
  double step = 0, when = 0;  ///< of the first
  double usual = 0;           ///< 99th percentile of the steps
  bool alike = true;          ///< all of the same size
};

Jumps jumps_of(const LogUnderCheck& c, const PositionColumn& column) {
  const Samples s(c.log, (c.log.*column.signal)[column.k]);
  std::vector<double> steps, rates;
  for (std::size_t i = 1; i < s.size(); ++i) {
    steps.push_back(std::abs(s.x[i] - s.x[i - 1]));
    rates.push_back(steps.back() / (s.time[i] - s.time[i - 1]));
  }
  Jumps jumps{.usual = quantile(steps, 0.99)};
  const double usual_rate = quantile(rates, 0.99);
  for (std::size_t i = 2; i + 2 < s.size(); ++i) {
    const double step = s.x[i] - s.x[i - 1];
    if (std::abs(step) < column.significant || rates[i - 1] < c.rule.jump * usual_rate) continue;
    // A jump stays; an outlier returns.
    const double stays = 0.5 * (s.x[i] + s.x[i + 1]) - 0.5 * (s.x[i - 1] + s.x[i - 2]);
    if (std::abs(stays / step - 1) > 0.25) continue;
    if (jumps.count++ == 0) jumps.step = step, jumps.when = s.time[i];
    jumps.alike = jumps.alike && std::abs(std::abs(step) - std::abs(jumps.step)) < 4 * jumps.usual;
  }
  return jumps;
}

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

std::string describe(const Jumps& jumps) {
  return fmt::format("jumps by {:.5g} between two samples at {:.4g} s", jumps.step, jumps.when) +
         (jumps.count > 1 ? fmt::format(", the first of {} jumps", jumps.count) : "");
}

void check_wraps(LogUnderCheck& c, const PositionColumn& column) {
  const std::string name = column_name(column.signal, column.k);
  const auto reject = [&](const std::string& what, const Period& period) {
    c.reject(name, what + "; expected a continuous position", "unwrap it with " + c.wrap_option(name, period.size));
  };
  const std::vector<double>& readings = (c.log.*column.signal)[column.k];
  const double longest = c.rule.lap_within * SampledColumn(c.log.time, readings).interval();
  if (const Period period = period_of(Samples(c.log, readings), column, longest); period.size > 0)
    return reject("starts again after " + period.what, period);
  const Jumps jumps = jumps_of(c, column);
  if (const Period period = period_of(jumps, column); jumps.count > 0 && period.size > 0)
    reject(describe(jumps) + ", which is " + period.what, period);
}

void check_jumps(LogUnderCheck& c, const PositionColumn& column) {
  const std::string name = column_name(column.signal, column.k);
  // A sensor that froze jumps where it wakes up, and a corrected column is told already.
  if (c.has_finding(name)) return;
  if (const Jumps jumps = jumps_of(c, column); jumps.count > 0)
    c.suspect(name, describe(jumps) + "; a motor or joint cannot follow",
              std::string("if the sensor froze or lost counts: ") + kLeaveEmpty);
}

void tell_outliers(LogUnderCheck& c, Signals Log::*signal, int k, const Outliers& found) {
  if (found.readings == 0) return;
  c.findings.push_back(
      {c.log.source, column_name(signal, k),
       fmt::format("{} reading{} far from the neighbours, at most by {:.4g} at {:.4g} s; usual is {:.2g}",
                   found.readings, found.readings == 1 ? " lies" : "s lie", found.largest, found.when, found.usual),
       "nothing to do: a diagnosis leaves these readings out; for other commands leave their cells empty",
       LogFinding::Severity::corrected});
}

/// The longest time during which a sensor does not change although it should.
void check_frozen(LogUnderCheck& c, const PositionColumn& column, const SampledMotion& m) {
  const int k = column.k;
  if (m.expected[k].empty() || m.joint[k].empty()) return;
  const bool is_stuck = std::ranges::count(stuck_joint_sensors(c.log, c.model), k) > 0;
  const Samples s(c.log, (c.log.*column.signal)[k]);
  const bool is_motor = column.signal == &Log::motor_position;
  const double least = c.rule.least_motion * c.range(k);
  double frozen = 0, from = 0, to = 0;
  const std::vector<Run> runs = runs_of(s.x);
  if (runs.empty()) return;
  const double held = usual_length(runs);
  for (const Run& run : runs) {
    std::vector<double> mismatch, other;
    const double begin = s.time[run.begin], end = s.time[run.end - 1];
    if (static_cast<double>(run.size()) < 5 * held || end - begin < kShortestFreeze) continue;
    for (auto i = static_cast<std::size_t>(std::ceil((begin - m.time[0]) / m.step));
         i < m.time.size() && m.time[i] <= end; ++i) {
      mismatch.push_back(m.joint[k][i] - m.expected[k][i]);
      other.push_back((is_motor ? m.joint : m.expected)[k][i]);
    }
    if (spread(mismatch) < least || spread(other) < least) continue;
    frozen += end - begin;
    if (end - begin > to - from) from = begin, to = end;
  }
  if (frozen == 0) return;
  const bool all = is_motor ? frozen > 0.9 * c.log.duration() : is_stuck;
  const std::string what =
      all ? fmt::format("never changes, while the {} moves the joint by {:.3g}", is_motor ? "joint's sensor" : "motor",
                        spread(is_motor ? m.joint[k] : m.expected[k]))
          : fmt::format("stands still for {:.3g} s while the {} moves, longest from {:.4g} to {:.4g} s", frozen,
                        is_motor ? "joint" : "motor", from, to);
  // A motor's angle drives every prediction; a joint's sensor is only compared.
  if (is_motor)
    c.reject(column_name(column.signal, k), what + "; expected the angle of the motor",
             "give the column of this motor's encoder, or a record in which it works");
  else c.suspect(column_name(column.signal, k), what + "; the sensor is stuck or not connected", kLeaveEmpty);
}

/// A position that often stops abruptly at the same extreme value: the end of a counter.
void check_end_of_counter(LogUnderCheck& c, const PositionColumn& column) {
  const Samples s(c.log, (c.log.*column.signal)[column.k]);
  // A frozen sensor is told already.
  if (s.size() < 20 || c.has_finding(column_name(column.signal, column.k))) return;
  std::vector<double> steps;
  for (std::size_t i = 3; i < s.size(); ++i) steps.push_back(std::abs(s.x[i] - s.x[i - 3]));
  const double usual = quantile(steps, 0.9);
  const std::vector<Run> runs = runs_of(s.x);
  const double held = std::max(10.0, 5 * usual_length(runs));
  const auto [low, high] = std::ranges::minmax(s.x);
  // A joint that is held steps to and fro between a few counts, or drifts a little, and ends at one of them.
  constexpr double kFewCounts = 20;
  double count = high - low;
  for (std::size_t i = 1; i < s.size(); ++i)
    if (s.x[i] != s.x[i - 1]) count = std::min(count, std::abs(s.x[i] - s.x[i - 1]));
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
      if (std::min(before, after) > 0.5 * usual) ++abrupt;
    }
    if (abrupt >= 2 && 2 * abrupt > all)
      c.suspect(column_name(column.signal, column.k),
                fmt::format("stops abruptly at its extreme value {:.6g} {} times, for {:.3g} s together: a counter or "
                            "converter at its end",
                            end, all, time),
                kLeaveEmpty);
  }
}

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

void check_idle(LogUnderCheck& c) {
  bool moves = false, torque = false;
  std::string first;  // column of the first motor
  for (int k = 0; k < c.n(); ++k) {
    if (!c.is_driven(k)) continue;
    if (first.empty()) first = column_name(&Log::motor_position, k);
    const double counts = 3 * c.model.nominal.joint[k].motor_encoder_resolution;
    const double least = std::max(counts, 1e-4 * c.range(k) / std::abs(c.joint_per_motor(k)));
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

void check_columns(LogUnderCheck& c) {
  const SampledMotion m = sampled_motion(c.log, c.model);
  for (const PositionColumn& column : position_columns(c)) {
    const std::size_t before = c.findings.size();
    check_frozen(c, column, m);
    check_end_of_counter(c, column);
    check_jumps(c, column);
    // Where a sensor jumps or wakes up, a sample may lie between.
    if (c.findings.size() == before)
      tell_outliers(c, column.signal, column.k,
                    find_outliers(c.log.time, (c.log.*column.signal)[column.k], c.rule.outlier.factor));
  }
  for (int k = 0; k < c.n(); ++k)
    if (c.is_driven(k)) tell_outliers(c, &Log::motor_torque, k, find_torque_outliers(c.log, k, c.rule.outlier));
}

void check_clipped_torques(LogUnderCheck& c) {
  for (int k = 0; k < c.n(); ++k)
    if (c.is_driven(k)) check_clipped_torque(c, k);
}

}  // namespace halyard

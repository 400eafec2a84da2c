#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/columns/column_samples.h"
#include "diagnosis/log_check/columns/end_of_counter.h"
#include "diagnosis/log_check/robust.h"
#include "diagnosis/record/record.h"

namespace halyard {
namespace {

constexpr double kShortestFreeze = 0.05;  ///< s; slow sensors hold a reading for 33 ms

void check_jumps(LogUnderCheck& c, const PositionColumn& column) {
  const std::string name = column.name();
  // A sensor that froze jumps where it wakes up, and a corrected column is told already.
  if (c.has_finding(name)) return;
  if (const Jumps jumps = jumps_of(c, column); jumps.count > 0)
    c.suspect(name, jumps.description() + "; a motor or joint cannot follow",
              "if the sensor froze or lost counts: " + leave_out(column));
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
    c.reject(column.name(), what + "; expected the angle of the motor",
             "give the column of this motor's encoder, or a record in which it works");
  else c.suspect(column.name(), what + "; the sensor is stuck or not connected", leave_out(column));
}

}  // namespace

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

}  // namespace halyard

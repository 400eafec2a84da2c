#include "diagnosis/log_check/own_readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "diagnosis/log_check/columns/column_samples.h"
#include "diagnosis/log_check/outliers.h"
#include "model/statistics/quantile.h"

namespace halyard {
namespace {

constexpr double kSteps = 3;  ///< of the sensor: what noise of one step and rounding make of a reading that changes
constexpr double kMost = 0.5;
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// Rows with equal readings.
struct EqualReadings : Run {
  double change;  ///< to the next reading
};

std::vector<EqualReadings> equal_readings(const std::vector<double>& x) {
  std::vector<EqualReadings> readings;
  for (const Run& run : runs_of(x)) {
    const double change = run.end < x.size() ? std::abs(x[run.end] - x[run.begin]) : 0;
    if (std::isfinite(x[run.begin])) readings.push_back({run, std::isfinite(change) ? change : 0});
  }
  return readings;
}

double smallest_change(const std::vector<EqualReadings>& runs) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const EqualReadings& run : runs)
    if (run.change > 0) smallest = std::min(smallest, run.change);
  return std::isfinite(smallest) ? smallest : 0;
}

/// The usual number of rows of a repeated reading; none if the column does not repeat its readings.
std::optional<std::size_t> rows_a_reading(const std::vector<EqualReadings>& runs, double step) {
  double way = 0, repeated_way = 0;
  std::vector<double> rows;
  for (const EqualReadings& run : runs) {
    way += run.change;
    if (run.size() < 2 || run.change <= kSteps * step) continue;
    repeated_way += run.change;
    rows.push_back(static_cast<double>(run.size()));
  }
  if (rows.empty() || repeated_way <= kMost * way) return {};
  return static_cast<std::size_t>(std::lround(median(rows)));
}

/// The rows that repeat a reading, the last first; none if the column does not repeat its readings. rows: the usual
/// number of rows of a reading.
std::vector<std::size_t> repeats_in(const std::vector<double>& x, double resolution, std::size_t& rows) {
  const std::vector<EqualReadings> runs = equal_readings(x);
  const double step = std::max(resolution, smallest_change(runs));
  const std::optional<std::size_t> usual = rows_a_reading(runs, step);
  std::vector<std::size_t> repeats;
  if (!usual) return repeats;
  rows = *usual;
  for (const EqualReadings& run : runs) {
    // A sensor at rest reads the same again.
    const std::size_t own = run.change > kSteps * step ? run.size() : rows;
    for (std::size_t i = run.begin; i < run.end; ++i)
      if ((i - run.begin) % own != 0 || (i > run.begin && i + own > run.end)) repeats.push_back(i);
  }
  std::ranges::reverse(repeats);
  return repeats;
}

LogFinding finding_of(const Log& log, const RepeatedReadings& r) {
  return {log.source, fmt::format("{}_position_{}", r.signal == &Log::motor_position ? "motor" : "joint", r.joint + 1),
          fmt::format("repeats each reading until the next one, {:.3g} ms later", 1e3 * r.interval),
          "nothing to do: the diagnosis has left the repeated ones out", LogFinding::Severity::corrected};
}

}  // namespace

std::vector<RepeatedReadings> keep_own_readings(Log& log, const ArmModel& model) {
  std::vector<RepeatedReadings> repeated;
  if (log.size() < 2) return repeated;
  const double row_s = log.duration() / static_cast<double>(log.size() - 1);
  for (int k = 0; k < log.n_joints; ++k) {
    const JointParameters<double>& j = model.nominal.joint[k];
    std::size_t rows = 0;
    std::vector<double>&torque = log.motor_torque[k], &motor = log.motor_position[k], &joint = log.joint_position[k];
    const std::vector<std::size_t> of_motor = repeats_in(motor, j.motor_encoder_resolution, rows);
    if (!of_motor.empty()) repeated.push_back({&Log::motor_position, k, row_s * static_cast<double>(rows)});
    for (const std::size_t i : of_motor) {
      motor[i] = kMissing;
      // A torque that comes with the position is repeated in the same rows.
      if (!torque.empty() && i > 0 && torque[i] == torque[i - 1]) torque[i] = kMissing;
    }
    const std::vector<std::size_t> of_joint = repeats_in(joint, j.joint_encoder_resolution, rows);
    if (!of_joint.empty()) repeated.push_back({&Log::joint_position, k, row_s * static_cast<double>(rows)});
    for (const std::size_t i : of_joint) joint[i] = kMissing;
  }
  return repeated;
}

Log usable_readings(Log log, const ArmModel& model, std::vector<LogFinding>* findings) {
  for (const RepeatedReadings& r : keep_own_readings(log, model))
    if (findings) findings->push_back(finding_of(log, r));
  return without_outliers(std::move(log));
}

UsableLogs usable_logs(const ArmModel& model, std::vector<Log> training, std::optional<Log> holdout,
                       const ColumnMap& columns) {
  UsableLogs usable{std::move(training), std::move(holdout), {}};
  std::vector<Log*> logs;
  for (Log& log : usable.training) logs.push_back(&log);
  if (usable.holdout) logs.push_back(&*usable.holdout);
  for (const Log* log : logs)
    for (LogFinding& finding : check_log(*log, model, columns)) usable.findings.push_back(std::move(finding));
  stop_at_gross_finding(usable.findings);
  for (Log* log : logs) *log = usable_readings(std::move(*log), model, &usable.findings);
  return usable;
}

}  // namespace halyard

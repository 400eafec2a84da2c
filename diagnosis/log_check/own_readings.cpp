#include "diagnosis/log_check/own_readings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "diagnosis/log_check/outliers.h"
#include "diagnosis/log_check/robust.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kSteps = 3;  ///< of the sensor, in which rounding leaves a reading as it is at most two
constexpr double kMost = 0.5;

/// Rows begin..end-1 with equal readings.
struct EqualReadings {
  std::size_t begin, end;
  double way;  ///< by which the motors lead the joint until the next reading
  std::size_t rows() const { return end - begin; }
};

/// Joint positions that the motors give without stretch, [n][rows].
Signals positions_by_motors(const Log& log, const ArmModel& model) {
  const int n = log.n_joints;
  const Eigen::VectorXd undriven = model.home();
  Signals by_motors(n, std::vector<double>(log.size()));
  const UnstretchedJoints unstretched(model.nominal);
  Eigen::VectorXd q_m(n), q;
  for (std::size_t i = 0; i < log.size(); ++i) {
    for (int k = 0; k < n; ++k) q_m(k) = log.motor_position[k].empty() ? 0 : log.motor_position[k][i];
    unstretched.solve(q_m, undriven, q);
    for (int k = 0; k < n; ++k) by_motors[k][i] = q(k);
  }
  return by_motors;
}

std::vector<EqualReadings> equal_readings(const std::vector<double>& x, const std::vector<double>& by_motors) {
  std::vector<EqualReadings> runs;
  for (std::size_t begin = 0, end = 0; begin < x.size(); begin = end) {
    double way = 0;
    for (end = begin + 1; end < x.size(); ++end) {
      if (const double moved = std::abs(by_motors[end] - by_motors[begin]); moved > way) way = moved;
      if (x[end] != x[begin]) break;
    }
    if (std::isfinite(x[begin])) runs.push_back({begin, end, way});
  }
  return runs;
}

double smallest_change(const std::vector<double>& x, const std::vector<EqualReadings>& runs) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t r = 1; r < runs.size(); ++r)
    smallest = std::min(smallest, std::abs(x[runs[r].begin] - x[runs[r - 1].begin]));
  return std::isfinite(smallest) ? smallest : 0;
}

/// The usual number of rows of a repeated reading; none if the column does not repeat its readings.
std::optional<std::size_t> rows_a_reading(const std::vector<EqualReadings>& runs, double step) {
  double way = 0, repeated_way = 0;
  std::vector<double> rows;
  for (const EqualReadings& run : runs) {
    way += run.way;
    if (run.rows() < 2 || run.way <= kSteps * step) continue;
    repeated_way += run.way;
    rows.push_back(static_cast<double>(run.rows()));
  }
  if (rows.empty() || repeated_way <= kMost * way) return {};
  return static_cast<std::size_t>(std::lround(median(rows)));
}

/// Keeps the first of every so many rows, if as many follow it.
void leave_own(const EqualReadings& run, std::size_t rows, std::vector<double>& x) {
  for (std::size_t i = run.begin; i < run.end; ++i)
    if ((i - run.begin) % rows != 0 || (i > run.begin && i + rows > run.end))
      x[i] = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<RepeatedReadings> keep_own_readings(Log& log, const ArmModel& model) {
  std::vector<RepeatedReadings> repeated;
  if (log.size() < 2) return repeated;
  const Signals by_motors = positions_by_motors(log, model);
  const double row_s = log.duration() / static_cast<double>(log.size() - 1);
  for (int k = 0; k < log.n_joints; ++k) {
    const JointParameters<double>& j = model.nominal.joint[k];
    std::vector<double>& x = log.joint_position[k];
    if (x.empty() || log.motor_position[k].empty() || j.drive == Drive::none) continue;
    const std::vector<EqualReadings> runs = equal_readings(x, by_motors[k]);
    const double step = std::max(j.joint_encoder_resolution, smallest_change(x, runs));
    const auto rows = rows_a_reading(runs, step);
    if (!rows) continue;
    for (const EqualReadings& run : runs) leave_own(run, run.way > kSteps * step ? run.rows() : *rows, x);
    repeated.push_back({k, row_s * static_cast<double>(*rows)});
  }
  return repeated;
}

Log usable_readings(Log log, const ArmModel& model) {
  keep_own_readings(log, model);
  return without_outliers(std::move(log));
}

}  // namespace halyard

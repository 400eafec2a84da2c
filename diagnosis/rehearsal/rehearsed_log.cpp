#include "diagnosis/rehearsal/rehearsed_log.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/holdout/holdout.h"
#include "diagnosis/record/resting.h"
#include "diagnosis/record/sampled_column.h"
#include "model/input_error.h"

namespace halyard {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// At the start of a record its past is unknown: what is left there belongs there.
constexpr double kSettles = kFitBand.settle_s;

/// Between two samples; nothing beyond the ends.
double interpolated(const std::vector<double>& samples, double steps) {
  if (!(steps >= 0 && steps <= static_cast<double>(samples.size() - 1))) return kMissing;
  const double before = std::min(std::floor(steps), static_cast<double>(samples.size() - 2));
  const auto i = static_cast<std::size_t>(before);
  return samples[i] + (steps - before) * (samples[i + 1] - samples[i]);
}

/// The records, compared sample by sample.
std::vector<Record> not_smoothed(std::vector<Record> records) {
  for (Record& r : records) r.compare = {1}, r.compare_sigma = 0;
  return records;
}

/// Of a sensor whose model does not state it: what its readings show (Evidence::floor()).
double unstated_resolution(const Log& log, const ArmModel& model, int k) {
  if (model.nominal.joint[k].joint_encoder_resolution > 0) return 0;
  return smallest_step(SampledColumn(log.time, log.joint_position[k]).samples());
}

}  // namespace

LoggedMotion::LoggedMotion(Log log, std::vector<Record> records, double late, const ArmModel& model,
                           const Hypothesis& found)
    : log_(std::move(log)), records_(std::move(records)), found_(predict_all(not_smoothed(records_), found)) {
  for (int k = 0; k < model.n(); ++k) {
    if (model.nominal.joint[k].drive == Drive::none) continue;
    const double smoothing = slowest_smoothing(model, k);
    const bool is_slow = late != 0 && has_slow_joint_sensor(log_, model, k);
    // Not of a sensor that is stuck: it stays as it is.
    if (records_.front().has_joint(k))
      add({&Log::joint_position, k, is_slow ? late : 0, unstated_resolution(log_, model, k)}, smoothing);
    // A record's torque is that of the middle of the time for which the command was held.
    const double interval = SampledColumn(log_.time, log_.motor_torque[k]).interval();
    const double later = 0.5 * seconds_held(interval, model.nominal.joint[k].torque_source);
    if (records_.front().has_torque(k)) add({&Log::motor_torque, k, -later, 0}, smoothing);
  }
  records_ = not_smoothed(std::move(records_));
}

void LoggedMotion::add(Column column, double smoothing) {
  const std::vector<double>& values = (log_.*column.signal)[column.joint];
  std::size_t r = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    const double t = log_.time[i] - column.late;
    while (r + 1 < records_.size() && t >= records_[r + 1].start) ++r;
    const Record& record = records_[r];
    Row row{i, r, (t - record.start) / record.dt, false};
    if (!std::isfinite(residual(column, row, found_, 0))) continue;
    const bool is_at_rest = column.signal == &Log::motor_torque &&
                            rests(record, column.joint, static_cast<std::size_t>(row.steps), smoothing);
    row.is_moved = !is_at_rest && t >= record.start + kSettles;
    column.rows.push_back(row);
  }
  columns_.push_back(std::move(column));
}

double LoggedMotion::residual(const Column& column, const Row& row, const std::vector<FullPrediction>& of,
                              double later) const {
  const FullPrediction& p = of[row.record];
  const double steps = row.steps + later / records_[row.record].dt;
  if (column.signal == &Log::motor_torque) return interpolated(p.torque_residual[column.joint], steps);
  return log_.joint_position[column.joint][row.row] - interpolated(p.joint_reading[column.joint], steps);
}

Log LoggedMotion::as_of(const Hypothesis& truth, Random& random) const { return made(truth, random, false); }

Log LoggedMotion::on_time_as_of(const Hypothesis& truth, Random& random) const { return made(truth, random, true); }

Log LoggedMotion::made(const Hypothesis& truth, Random& random, bool on_time) const {
  const std::vector<FullPrediction> by_truth = predict_all(records_, truth);
  const double share = random.uniform(0.1, 0.9);
  Log log = log_;
  for (const Column& column : columns_) {
    const bool is_joint = column.signal == &Log::joint_position;
    std::vector<double>& values = (log.*column.signal)[column.joint];
    std::ranges::fill(values, kMissing);  // where nothing is predicted
    std::vector<const Row*> moved;
    for (const Row& row : column.rows)
      if (row.is_moved) moved.push_back(&row);
    const auto on = static_cast<std::size_t>(share * static_cast<double>(moved.size()));
    std::size_t next = 0;
    for (const Row& row : column.rows) {
      const Row& from = row.is_moved ? *moved[(next++ + on) % moved.size()] : row;
      const double of_truth = residual(column, row, by_truth, on_time && is_joint ? column.late : 0);
      if (row.is_moved && !on_time && !std::isfinite(of_truth))
        throw InputError(log_.source + ": the rehearsed arm cannot be integrated along its motion");
      const double x = (log_.*column.signal)[column.joint][row.row] - of_truth + residual(column, from, found_, 0);
      values[row.row] = column.resolution > 0 ? column.resolution * std::round(x / column.resolution) : x;
    }
  }
  return log;
}

std::vector<Record> rehearsal_records(const Log& log, const ArmModel& model) {
  Log everywhere = log;
  for (Signals Log::*signal : {&Log::joint_position, &Log::motor_torque})
    for (int k = 0; k < log.n_joints; ++k) {
      if (model.nominal.joint[k].drive == Drive::none)
        continue;  // its readings tell its motion, and where there is none
      const SampledColumn readings(log.time, (log.*signal)[k]);
      for (std::size_t i = 0; readings.is_there() && i < log.size(); ++i)
        (everywhere.*signal)[k][i] = readings.at(log.time[i]);
    }
  RecordOptions options = kFitBand;
  options.settle_s = 0;
  return make_records(everywhere, model, options);
}

}  // namespace halyard

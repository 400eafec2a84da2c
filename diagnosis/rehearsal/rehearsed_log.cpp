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

/// Between two samples.
double interpolated(const std::vector<double>& samples, double place) {
  const double before = std::min(std::floor(place), static_cast<double>(samples.size() - 2));
  const auto i = static_cast<std::size_t>(before);
  return samples[i] + (place - before) * (samples[i + 1] - samples[i]);
}

}  // namespace

LoggedMotion::LoggedMotion(Log log, std::vector<Record> records, double late, const ArmModel& model,
                           const Hypothesis& found)
    : log_(std::move(log)), records_(std::move(records)), found_(predict_all(records_, found)) {
  for (int k = 0; k < model.n(); ++k) {
    if (model.nominal.joint[k].drive == Drive::none) continue;
    const double smoothing = slowest_smoothing(model, k);
    const bool is_slow = late != 0 && has_slow_joint_sensor(log_, model, k);
    // Not of a sensor that is stuck: it stays as it is.
    if (records_.front().has_joint(k))
      columns_.push_back(column_of(&Log::joint_position, k, is_slow ? late : 0, smoothing));
    if (records_.front().has_torque(k)) columns_.push_back(column_of(&Log::motor_torque, k, 0, smoothing));
  }
}

LoggedMotion::Column LoggedMotion::column_of(Signals Log::*signal, int joint, double late, double smoothing) const {
  Column column{signal, joint};
  const std::vector<double>& values = (log_.*signal)[joint];
  std::size_t r = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    const double t = log_.time[i] - late;
    while (r + 1 < records_.size() && t >= records_[r + 1].start) ++r;
    const Record& record = records_[r];
    Row row{i, r, (t - record.start) / record.dt, false};
    if (row.place < 0 || row.place > static_cast<double>(record.size - 1)) continue;
    const bool is_at_rest =
        signal == &Log::motor_torque && rests(record, joint, static_cast<std::size_t>(row.place), smoothing);
    row.is_moved = !is_at_rest && t >= record.start + kSettles && std::isfinite(residual(column, row, found_));
    column.rows.push_back(row);
  }
  return column;
}

double LoggedMotion::residual(const Column& column, const Row& row, const std::vector<FullPrediction>& by) const {
  const FullPrediction& p = by[row.record];
  if (column.signal == &Log::motor_torque) return interpolated(p.torque_residual[column.joint], row.place);
  return log_.joint_position[column.joint][row.row] - interpolated(p.joint_reading[column.joint], row.place);
}

Log LoggedMotion::as_of(const Hypothesis& truth, Random& random) const {
  const std::vector<FullPrediction> by_truth = predict_all(records_, truth);
  const double by = random.uniform(0.1, 0.9);
  Log log = log_;
  for (const Column& column : columns_) {
    std::vector<double>& values = (log.*column.signal)[column.joint];
    std::ranges::fill(values, kMissing);  // where nothing is predicted
    std::vector<const Row*> moved;
    for (const Row& row : column.rows)
      if (row.is_moved) moved.push_back(&row);
    const auto shift = static_cast<std::size_t>(by * static_cast<double>(moved.size()));
    std::size_t next = 0;
    for (const Row& row : column.rows) {
      const Row& from = row.is_moved ? *moved[(next++ + shift) % moved.size()] : row;
      const double of_truth = residual(column, row, by_truth);
      if (row.is_moved && !std::isfinite(of_truth))
        throw InputError(log_.source + ": the rehearsed arm cannot be integrated along its motion");
      values[row.row] = (log_.*column.signal)[column.joint][row.row] - of_truth + residual(column, from, found_);
    }
  }
  return log;
}

std::vector<Record> rehearsal_records(const Log& log, const ArmModel& model) {
  Log everywhere = log;
  for (Signals Log::*signal : {&Log::joint_position, &Log::motor_torque})
    for (int k = 0; k < log.n_joints; ++k) {
      const SampledColumn readings(log.time, (log.*signal)[k]);
      for (std::size_t i = 0; readings.is_there() && i < log.size(); ++i)
        (everywhere.*signal)[k][i] = readings.at(log.time[i]);
    }
  RecordOptions options = kFitBand;
  options.compare_hz = 0;
  options.settle_s = 0;
  return make_records(everywhere, model, options);
}

}  // namespace halyard

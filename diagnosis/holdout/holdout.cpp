#include "diagnosis/holdout/holdout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "diagnosis/calibration/lateness.h"
#include "diagnosis/fit/fit.h"
#include "diagnosis/judgement/paired_t.h"
#include "diagnosis/log_check/robust.h"
#include "diagnosis/record/common_clock.h"
#include "diagnosis/record/resting.h"
#include "model/input_error.h"

namespace halyard {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Sums of errors.
struct ErrorSums {
  double count = 0, sum = 0, square = 0, peak = 0;

  void add(double e) { count += 1, sum += e, square += e * e, peak = std::max(peak, std::abs(e)); }
  double mean() const { return count > 0 ? sum / count : kNone; }
  double rms() const { return count > 0 ? std::sqrt(square / count) : kNone; }
  double spread() const { return count > 0 ? std::sqrt(std::max(0.0, square / count - mean() * mean())) : kNone; }
};

using ErrorOfSample = std::function<double(const Record&, const FullPrediction&, int, std::size_t)>;

struct ErrorsOfJoint {
  ErrorsOfJoint(const std::vector<Record>& records, const std::vector<FullPrediction>& predictions, int k, double v_s,
                const ErrorOfSample& error) {
    for (std::size_t r = 0; r < records.size(); ++r)
      for (std::size_t i = 0; i < records[r].size; ++i) {
        const double e = error(records[r], predictions[r], k, i);
        if (std::isnan(e)) continue;
        all.add(e);
        (rests(records[r], k, i, v_s) ? resting : moving).add(e);
      }
  }

  void add_to(ErrorParts& parts) const {
    parts.bias.push_back(all.mean());
    parts.spread.push_back(all.spread());
    parts.moving_rms.push_back(moving.rms());
    parts.resting_rms.push_back(resting.rms());
  }

  ErrorSums all, moving, resting;
};

/// Takes out what was before a time.
void compare_from(Record& r, double from) {
  for (Signals* valid : {&r.joint_valid, &r.torque_valid})
    for (std::vector<double>& x : *valid)
      for (std::size_t i = 0; i < x.size() && r.time(i) < from; ++i) x[i] = 0;
}

/// Appends the means of x, samples of one record, over equal blocks of about so many samples.
void add_block_means(const std::vector<double>& x, double block, std::vector<double>& means) {
  const auto n = x.size();
  const auto blocks = static_cast<std::size_t>(std::max(1L, std::lround(static_cast<double>(n) / block)));
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t first = b * n / blocks, end = (b + 1) * n / blocks;
    double sum = 0;
    for (std::size_t i = first; i < end; ++i) sum += x[i];
    if (end > first) means.push_back(sum / static_cast<double>(end - first));
  }
}

/// s between the samples of a record at these times, at which something is compared: those of the sensor, if it is
/// slower than the grid.
double interval_of(const Record& record, const std::vector<double>& times) {
  return times.size() > 1 ? std::max(record.dt, mean_interval(times)) : record.dt;
}

/// True if the squares of `error` grow from `before` to `after`, beyond chance and beyond what matters; or if there is
/// no prediction any more. Chance: a paired t test over blocks of a second, or shorter ones of a short hold-out.
bool grows(const HoldOut& view, int k, double floor, const ErrorOfSample& error) {
  constexpr double kShare = 0.025, kSignificance = 0.01, kLongest = 1, kShortest = 0.25, kBlocks = 8;
  std::vector<std::vector<double>> growth(view.records.size());  // of the squares, [record][compared sample]
  std::vector<double> interval;                                  // [record]
  double before = 0, after = 0, count = 0, seconds = 0;
  for (std::size_t r = 0; r < view.records.size(); ++r) {
    const Record& record = view.records[r];
    std::vector<double> times;
    for (std::size_t i = 0; i < record.size; ++i) {
      const double e = error(record, view.before[r], k, i), f = error(record, view.after[r], k, i);
      if (std::isnan(e)) continue;
      if (std::isnan(f)) return true;
      growth[r].push_back(f * f - e * e);
      times.push_back(record.time(i));
      before += e * e, after += f * f, count += 1;
    }
    interval.push_back(interval_of(record, times));
    seconds += interval[r] * static_cast<double>(growth[r].size());
  }
  if (count == 0 || after - before < count * floor * floor || after - before < kShare * before) return false;
  const double block_s = std::clamp(seconds / kBlocks, kShortest, kLongest);
  std::vector<double> means;
  for (std::size_t r = 0; r < growth.size(); ++r) add_block_means(growth[r], block_s / interval[r], means);
  return p_value(paired(means)) < kSignificance;
}

/// [2n] Root mean square of the change of each channel that the tolerances of the model cause together; NaN without
/// samples.
std::vector<double> tolerance_spreads(const std::vector<Record>& records, const ArmModel& model) {
  constexpr int kStride = 10;  // residuals change slowly with the model's numbers
  std::vector<Hypothesis> all = {{model.nominal, model.effects}};
  for (const FitParameter& p : baseline_parameters(model)) {
    all.push_back(all[0]);
    set_parameter(all.back(), p, p.upper);
  }
  std::vector<ErrorSums> spread(2 * static_cast<std::size_t>(model.n()));
  for (const Record& record : records) {
    const std::vector<Residuals> e = predict(record, all, kStride);
    for (std::size_t c = 0; c < spread.size(); ++c)
      for (std::size_t i = 0; i < e[0].channel[c].size(); ++i) {
        const double given = e[0].channel[c][i];
        if (std::isnan(given)) continue;
        double square = 0;
        for (std::size_t p = 1; p < e.size(); ++p) square += e[p].finite ? std::pow(e[p].channel[c][i] - given, 2) : 0;
        spread[c].add(std::sqrt(square));
      }
  }
  std::vector<double> all_rms;
  for (const ErrorSums& sums : spread) all_rms.push_back(sums.rms());
  return all_rms;
}

/// Seconds of the records that are compared, in the channel of which there are most.
double compared_seconds(const std::vector<Record>& records) {
  double most = 0;
  for (const Signals Record::*valid : {&Record::joint_valid, &Record::torque_valid})
    for (int k = 0; !records.empty() && k < records.front().n; ++k) {
      double seconds = 0;
      for (const Record& r : records) {
        std::vector<double> times;
        for (std::size_t i = 0; i < r.size; ++i)
          if ((r.*valid)[k][i] > 0) times.push_back(r.time(i));
        seconds += interval_of(r, times) * static_cast<double>(times.size());
      }
      most = std::max(most, seconds);
    }
  return most;
}

/// Throws InputError if gaps leave too little of the last thirds of the training logs for worse_joints().
void expect_holdout(const DiagnosisData& data, const std::vector<Log>& training) {
  constexpr double kLeast = 0.7;  // s: rounded, three of the shortest blocks of grows()
  const double held_out =
      std::max(compared_seconds(data.joint_view.records), compared_seconds(data.torque_view.records));
  // Of data without anything to compare, Evidence tells more.
  if (held_out >= kLeast || compared_seconds(data.training) == 0) return;
  throw InputError(
      fmt::format("{}: the last third of each log is held out, and its gaps leave {:.2g} s of it to compare; expected "
                  "at least {:g} s, or a hold-out log of its own",
                  training.front().source, held_out, kLeast));
}

/// Of each training log, and then of a hold-out log. One that is too short to tell has the sensors of the training log
/// before it, or of the next that can tell. If no training log can tell, none is moved: what the fits then find is
/// judged on a hold-out in the same state.
std::vector<double> lateness_of(const std::vector<Log>& training, const std::optional<Log>& holdout,
                                const ArmModel& model) {
  std::vector<std::optional<double>> told;
  for (const Log& log : training) told.push_back(slow_sensor_lateness(log, model));
  for (std::size_t i = 1; i < told.size(); ++i)
    if (!told[i]) told[i] = told[i - 1];
  for (std::size_t i = told.size(); i-- > 1;)
    if (!told[i - 1]) told[i - 1] = told[i];
  if (holdout && !told.empty()) {
    const std::optional<double> of_training = told.back();
    told.push_back(of_training ? slow_sensor_lateness(*holdout, model) : std::nullopt);
    if (!told.back()) told.back() = of_training;
  }
  std::vector<double> late;
  for (const std::optional<double>& t : told) late.push_back(t.value_or(0));
  return late;
}

}  // namespace

DiagnosisData diagnosis_data(const ArmModel& model, const std::vector<Log>& training, const std::optional<Log>& holdout,
                             const ArmModel& tells_lateness) {
  DiagnosisData data;
  const auto place_among_training = [&](Record& r, std::size_t first) {
    for (std::size_t place = first; place < data.training.size(); ++place)
      if (data.training[place].start == r.start) r.place = static_cast<int>(place);
  };
  const auto in_band = [](RecordOptions band, double late) {
    band.slow_sensors_late_s = late;
    return band;
  };
  const auto learn_from = [&](const Log& log, double late, double clock_shift) {
    const std::size_t first = data.training.size();
    for (Record& r : make_records(log, model, in_band(kFitBand, late))) {
      r.clock_shift = clock_shift;
      data.training.push_back(std::move(r));
    }
    for (Record& r : make_records(log, model, in_band(kJointErrorBand, late))) {
      r.clock_shift = clock_shift;
      place_among_training(r, first);
      data.training_joints.push_back(std::move(r));
    }
  };
  const auto hold_out = [&](const Log& log, double late, double clock_shift, double from, std::size_t first) {
    for (const auto& [view, how] :
         {std::pair(&data.joint_view, kJointErrorBand), std::pair(&data.torque_view, kFitBand)})
      for (Record& r : make_records(log, model, in_band(how, late))) {
        if (r.time(r.size - 1) < from) continue;
        r.clock_shift = clock_shift;
        compare_from(r, from);
        place_among_training(r, first);
        view->records.push_back(std::move(r));
      }
  };
  std::vector<Log> parts, untouched;
  for (const Log& log : training) {
    auto [first, last] = split_log(log, kTrainingShare);
    parts.push_back(holdout ? log : std::move(first));
    untouched.push_back(std::move(last));
  }
  const std::vector<double> late = lateness_of(parts, holdout, tells_lateness), shifts = clock_shifts(training);
  for (std::size_t i = 0; i < late.size(); ++i)
    if (late[i] != 0) data.late.push_back({i < parts.size() ? parts[i].source : holdout->source, late[i]});
  for (std::size_t i = 0; i < training.size(); ++i) {
    const std::size_t place = data.training.size();
    learn_from(parts[i], late[i], shifts[i]);
    if (!holdout) hold_out(training[i], late[i], shifts[i], untouched[i].time.front(), place);
  }
  if (holdout) hold_out(*holdout, late.empty() ? 0 : late.back(), 0, holdout->time.front(), data.training.size());
  else expect_holdout(data, training);
  return data;
}

double joint_error(const Record& r, const FullPrediction& p, int k, std::size_t i) {
  return r.has_joint(k) && r.joint_valid[k][i] > 0 ? r.joint_raw[k][i] - p.joint_reading[k][i] : kNone;
}

double torque_error(const Record& r, const FullPrediction& p, int k, std::size_t i) {
  return r.has_torque(k) && r.torque_valid[k][i] > 0 ? p.torque_residual[k][i] : kNone;
}

PredictionError prediction_errors(const HoldOut& joints, const HoldOut& torques, const ArmParameters<double>& arm,
                                  std::vector<FullPrediction> HoldOut::*which) {
  PredictionError e;
  for (int k = 0; k < arm.n; ++k) {
    const double v_s = arm.joint[k].motor_smoothing;
    const ErrorsOfJoint joint(joints.records, joints.*which, k, v_s, joint_error);
    const ErrorsOfJoint torque(torques.records, torques.*which, k, v_s, torque_error);
    e.joint_rms.push_back(joint.all.rms());
    e.joint_peak.push_back(joint.all.count > 0 ? joint.all.peak : kNone);
    e.torque_rms.push_back(torque.all.rms());
    joint.add_to(e.joint);
    torque.add_to(e.torque);
  }
  return e;
}

std::vector<FullPrediction> predict_all(const std::vector<Record>& records, const Hypothesis& hypothesis) {
  std::vector<FullPrediction> all;
  for (const Record& r : records) all.push_back(predict_fully(r, hypothesis));
  return all;
}

std::vector<double> holdout_floors(const Evidence& evidence, const ArmModel& model, const HoldOut& joints,
                                   const HoldOut& torques) {
  std::vector<double> floor = evidence.floor();
  const int n = evidence.n();
  for (const auto& [first, view] : {std::pair(0, &torques), std::pair(n, &joints)}) {
    const std::vector<Record>& records = view->records;
    std::vector<int> unseen;
    for (int k = 0; k < n; ++k)
      if (!evidence.has_channel(first + k) && std::ranges::any_of(records, [&, first = first](const Record& r) {
            return first == 0 ? r.has_torque(k) : r.has_joint(k);
          }))
        unseen.push_back(first + k);
    if (unseen.empty()) continue;
    const std::vector<double> spread = tolerance_spreads(records, model);
    for (const int c : unseen) floor[c] = std::max(floor[c], spread[c]);
  }
  return floor;
}

namespace {

/// NaN where the motor of joint k rests as well: its friction has any value that balance asks for, in the fits, too.
ErrorOfSample moving_torque_error(const ArmModel& model, int k) {
  return [v_s = slowest_smoothing(model, k)](const Record& r, const FullPrediction& p, int joint, std::size_t i) {
    const double e = torque_error(r, p, joint, i);
    return std::isnan(e) || rests(r, joint, i, v_s) ? kNone : e;
  };
}

}  // namespace

double error_over_floors(const ArmModel& model, const HoldOut& joints, const HoldOut& torques,
                         std::vector<FullPrediction> HoldOut::*which, const std::vector<double>& floor) {
  const int n = static_cast<int>(floor.size()) / 2;
  double sum = 0;
  const auto add = [&](const HoldOut& view, int k, double of_channel, const ErrorOfSample& error) {
    if (!(of_channel > 0)) return;
    for (std::size_t r = 0; r < view.records.size(); ++r)
      for (std::size_t i = 0; i < view.records[r].size; ++i) {
        if (std::isnan(error(view.records[r], view.before[r], k, i))) continue;
        const double e = error(view.records[r], (view.*which)[r], k, i);
        sum += std::isnan(e) ? std::numeric_limits<double>::infinity() : std::pow(e / of_channel, 2);
      }
  };
  for (int k = 0; k < n; ++k) {
    add(torques, k, floor[k], moving_torque_error(model, k));
    add(joints, k, floor[n + k], joint_error);
  }
  return sum;
}

std::vector<int> worse_joints(const ArmModel& model, const HoldOut& joints, const HoldOut& torques,
                              const std::vector<double>& floor) {
  const int n = static_cast<int>(floor.size()) / 2;
  std::vector<int> worse;
  for (int k = 0; k < n; ++k) {
    if (grows(joints, k, floor[n + k], joint_error) || grows(torques, k, floor[k], moving_torque_error(model, k)))
      worse.push_back(k);
  }
  return worse;
}

}  // namespace halyard

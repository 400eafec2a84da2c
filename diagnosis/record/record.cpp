#include "diagnosis/record/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "diagnosis/log_check/robust.h"
#include "diagnosis/record/sampled_column.h"
#include "diagnosis/record/settling.h"
#include "diagnosis/record/start_of_motion.h"
#include "estimators/process/process_model.h"
#include "model/homing.h"
#include "model/input_error.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

/// σ_t of a cut-off, s.
double sigma_of(double cutoff_hz) { return 1 / (2 * std::numbers::pi * cutoff_hz); }

/// Gaussian kernel of a cut-off and its first two derivatives on the sample grid, as correlation weights.
struct Kernel {
  std::vector<double> value, slope, curvature;  ///< [2 reach + 1]
  int reach;
};

Kernel gaussian_kernel(double cutoff_hz, double dt) {
  const double sigma_samples = sigma_of(cutoff_hz) / dt;
  Kernel k;
  k.reach = std::max(2, static_cast<int>(std::ceil(4 * sigma_samples)));
  double mass = 0, second = 0, fourth = 0;
  std::vector<double> g;
  for (int i = -k.reach; i <= k.reach; ++i) {
    g.push_back(std::exp(-0.5 * i * i / (sigma_samples * sigma_samples)));
    mass += g.back();
    second += g.back() * i * i;
    fourth += g.back() * std::pow(i, 4);
  }
  // Moments decide the scale: a ramp's slope is Σ g i x / Σ g i², a parabola's curvature likewise.
  const double mean_square = second / mass;
  const double curvature = 2 / (fourth - second * mean_square);
  for (int i = -k.reach; i <= k.reach; ++i) {
    const double w = g[i + k.reach];
    k.value.push_back(w / mass);
    k.slope.push_back(w * i / (second * dt));
    k.curvature.push_back(curvature * w * (i * i - mean_square) / (dt * dt));
  }
  return k;
}

/// Σ w(i) x(t + i). Past the ends the signal goes on by point reflection, which keeps a ramp a ramp.
std::vector<double> correlate(const std::vector<double>& x, const std::vector<double>& w, int reach) {
  const int n = static_cast<int>(x.size());
  const auto at = [&](int i) {
    if (i < 0) return 2 * x.front() - x[std::min(-i, n - 1)];
    if (i >= n) return 2 * x.back() - x[std::max(2 * n - 2 - i, 0)];
    return x[i];
  };
  std::vector<double> y(n);
  for (int t = 0; t < n; ++t) {
    double sum = 0;
    if (t >= reach && t + reach < n) {
      for (int i = -reach; i <= reach; ++i) sum += w[i + reach] * x[t + i];
    } else {
      for (int i = -reach; i <= reach; ++i) sum += w[i + reach] * at(t + i);
    }
    y[t] = sum;
  }
  return y;
}

std::vector<double> earlier(std::vector<double> time, double by) {
  for (double& t : time) t -= by;
  return time;
}

/// A stretch of a log: its columns, and the fine grid on which they are filtered.
class Stretch {
 public:
  Stretch(Log part, const ArmModel& model, const RecordOptions& options)
      : log_(std::move(part)), model_(model), options_(options) {
    const Log& log = log_;
    double fastest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < log.n_joints; ++k) {
      const bool driven = model.nominal.joint[k].drive != Drive::none;
      motion_.emplace_back(log.time, driven ? log.motor_position[k] : log.joint_position[k]);
      torque_.emplace_back(log.time, log.motor_torque[k]);
      const bool slow = options.slow_sensors_late_s != 0 && has_slow_joint_sensor(log, model, k);
      joint_.emplace_back(slow ? earlier(log.time, options.slow_sensors_late_s) : log.time, log.joint_position[k]);
      external_.emplace_back(log.time, log.joint_torque[k]);
      for (const SampledColumn* c : {&motion_[k], &torque_[k], &joint_[k]})
        if (c->is_there()) fastest = std::min(fastest, c->interval());
    }
    if (!std::isfinite(fastest))
      throw InputError(log.source + ": has no motion, no torque and no joint sensor of this arm; give a log with one");
    start_ = log.time.front();
    // Whole samples to a step of the grid, or whole steps to a sample.
    const double ratio = options.step_s / fastest;
    stride_ = static_cast<std::size_t>(std::max(1.0, std::floor(ratio + 1e-6)));
    dt_ = ratio >= 1 ? fastest : fastest / std::ceil(1 / ratio - 1e-6);
    size_ = static_cast<std::size_t>(std::floor(log.duration() / dt_ + 0.5)) + 1;
    kernel_ = gaussian_kernel(options.motion_hz, dt_);
  }

  Record record() const {
    Record r;
    r.n = log_.n_joints;
    r.dt = dt_ * static_cast<double>(stride_);
    r.start = start_;
    r.size = (size_ + stride_ - 1) / stride_;
    r.source = log_.source;
    r.motion_sigma = sigma_of(options_.motion_hz);
    r.compare = {1};
    if (options_.compare_hz > 0) {
      r.compare = gaussian_kernel(options_.compare_hz, r.dt).value;
      r.compare_sigma = sigma_of(options_.compare_hz);
    }
    for (Signals* s : {&r.motor_angle, &r.motor_rate, &r.motor_acceleration, &r.torque, &r.joint, &r.joint_raw,
                       &r.external, &r.joint_measured, &r.torque_measured, &r.joint_valid, &r.torque_valid})
      s->resize(r.n);
    for (int k = 0; k < r.n; ++k) {
      r.joint_samples.push_back(joint_[k].samples());
      add_joint(k, r);
    }
    return r;
  }

 private:
  void add_joint(int k, Record& r) const {
    const JointParameters<double>& j = model_.nominal.joint[k];
    const bool driven = j.drive != Drive::none, moves = motion_[k].is_there();
    std::vector<double> angle(size_, driven ? 0 : model_.joints[k].home + j.joint_encoder_offset);
    if (moves) angle = on_grid(motion_[k], 0);
    r.motor_angle[k] = filtered(angle, kernel_.value);
    r.motor_rate[k] = filtered(angle, kernel_.slope);
    r.motor_acceleration[k] = filtered(angle, kernel_.curvature);
    if (external_[k].is_there()) r.external[k] = filtered(on_grid(external_[k], 0), kernel_.value);
    if (torque_[k].is_there() && driven) {
      r.torque[k] =
          filtered(on_grid(torque_[k], -0.5 * seconds_held(torque_[k].interval(), j.torque_source)), kernel_.value);
    }
    if (joint_[k].is_there()) {
      const std::vector<double> reading = on_grid(joint_[k], 0);
      r.joint[k] = filtered(reading, kernel_.value);
      r.joint_raw[k] = every_stride(reading);
    }

    r.torque_measured[k] = r.joint_measured[k] = r.torque_valid[k] = r.joint_valid[k] = std::vector<double>(r.size, 0);
    for (std::size_t i = 0; i < r.size; ++i) {
      const double t = r.time(i);
      // An undriven joint's motion is given, and with it nothing is left to compare.
      if (!driven || t < start_ + options_.settle_s - 1e-9 || !is_known(motion_[k], t)) continue;
      if (external_[k].is_there() && !is_known(external_[k], t)) continue;
      const auto measured = [&](const SampledColumn& c) {
        return c.is_there() && c.distance(t) <= 0.51 * r.dt ? 1 : 0;
      };
      r.joint_measured[k][i] = measured(joint_[k]);
      // Near an end the torque's filter sees a signal that was made up.
      const double reach = dt_ * kernel_.reach - 1e-9;
      if (t >= start_ + reach && t <= log_.time.back() - reach) r.torque_measured[k][i] = measured(torque_[k]);
    }
    r.joint_valid[k] = comparable(r.joint_measured[k], r, joint_[k].interval());
    r.torque_valid[k] = comparable(r.torque_measured[k], r, torque_[k].interval());
  }

  /// False in a hole between samples that the kernel does not bridge.
  bool is_known(const SampledColumn& c, double time) const {
    return c.hole_at(time) <= std::max(1.5 * c.usual_hole(), sigma_of(options_.motion_hz));
  }

  /// Where the comparing kernel sees enough samples of a signal about it.
  static std::vector<double> comparable(const std::vector<double>& measured, const Record& r, double interval) {
    constexpr double kEnough = 0.7;  // of what it usually sees of the signal, holes left out
    // Single rows that are lost, and bursts, make the samples fewer than the usual interval says.
    std::vector<double> times;
    for (std::size_t i = 0; i < r.size; ++i)
      if (measured[i] > 0) times.push_back(r.time(i));
    const double usual = std::min(1.0, r.dt / std::max(interval, mean_interval(times)));
    const auto size = static_cast<std::ptrdiff_t>(r.size), reach = static_cast<std::ptrdiff_t>(r.compare.size() / 2);
    std::vector<double> valid(r.size, 0);
    for (std::ptrdiff_t i = 0; i < size; ++i) {
      double weight = 0;
      for (std::ptrdiff_t t = std::max<std::ptrdiff_t>(0, i - reach); t < std::min(size, i + reach + 1); ++t)
        weight += r.compare[t - i + reach] * measured[t];
      valid[i] = weight >= kEnough * usual;
    }
    return valid;
  }

  std::vector<double> on_grid(const SampledColumn& c, double later) const {
    std::vector<double> y(size_);
    for (std::size_t i = 0; i < size_; ++i) y[i] = c.at(start_ + dt_ * static_cast<double>(i) + later);
    return y;
  }
  std::vector<double> filtered(const std::vector<double>& x, const std::vector<double>& kernel) const {
    return every_stride(correlate(x, kernel, kernel_.reach));
  }
  std::vector<double> every_stride(const std::vector<double>& x) const {
    std::vector<double> y;
    for (std::size_t i = 0; i < x.size(); i += stride_) y.push_back(x[i]);
    return y;
  }

  const Log log_;
  const ArmModel& model_;
  const RecordOptions& options_;
  std::vector<SampledColumn> motion_, torque_, joint_, external_;
  double start_, dt_;
  std::size_t stride_, size_;
  Kernel kernel_;
};

std::pair<double, double> range_of(const std::vector<double>& x) {
  std::pair range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double v : x)
    if (std::isfinite(v)) range = {std::min(range.first, v), std::max(range.second, v)};
  return range;
}

bool never_changes(const std::vector<double>& x) {
  const auto [low, high] = range_of(x);
  return low == high;
}

/// The log with its zeros found, and without columns that tell nothing.
Log usable(Log log, const ArmModel& model) {
  for (const int k : stuck_joint_sensors(log, model)) log.joint_position[k].clear();
  for (int k = 0; k < log.n_joints; ++k) {
    const JointParameters<double>& j = model.nominal.joint[k];
    const bool told = j.drive == Drive::none || j.joint_encoder_resolution > 0;
    if (!told && never_changes(log.joint_position[k])) log.joint_position[k].clear();
    if (range_of(log.motor_torque[k]) == std::pair(0.0, 0.0)) log.motor_torque[k].clear();
  }
  home_encoders(log, model);
  return log;
}

/// 1/s; 0 if the model's rates are not finite, which its prediction tells.
double fastest_rate(const ArmModel& model) {
  try {
    return ProcessModel(model).stiffest_rate();
  } catch (const std::runtime_error&) {
    return 0;
  }
}

/// Of the integration by hypotheses about an arm of this fastest rate: their frictions may be some times the model's,
/// and coarse records have twice the step.
int most_stages_for(double fastest, double dt) {
  constexpr double kSomeTimes = 3, kCoarse = 2;
  const int stages = stages_for({{-kSomeTimes * fastest}}, kCoarse * dt, RungeKuttaChebyshev::kMostStages);
  return stages == 0 ? RungeKuttaChebyshev::kMostStages : std::max(stages, RungeKuttaChebyshev::kUsualStages);
}

/// What a row is to the stretches of a log that have no long gap in what tells the motion.
enum class Row { goes_on, begins, lost };

std::vector<Row> mark_gaps(const Log& log, const ArmModel& model, double longest_gap) {
  std::vector<Row> mark(log.size(), Row::goes_on);
  const auto look_at = [&](const std::vector<double>& x) {
    const double allowed = std::max(longest_gap, 1.5 * SampledColumn(log.time, x).interval());
    std::ptrdiff_t last = -1;
    for (std::size_t i = 0; i <= log.size(); ++i) {
      if (i < log.size() && std::isnan(x[i])) continue;
      const double from = log.time[std::max<std::ptrdiff_t>(last, 0)], to = log.time[std::min(i, log.size() - 1)];
      if (to - from > allowed) {
        for (std::size_t g = last + 1; g < i; ++g) mark[g] = Row::lost;
        if (i < log.size()) mark[i] = std::max(mark[i], Row::begins);
      }
      last = static_cast<std::ptrdiff_t>(i);
    }
  };
  for (int k = 0; k < log.n_joints; ++k)
    if (model.nominal.joint[k].drive != Drive::none) look_at(log.motor_position[k]);
    else if (log.has_joint_position(k)) look_at(log.joint_position[k]);
  look_at(log.time);
  return mark;
}

}  // namespace

double seconds_held(double interval, TorqueSource source) {
  return source == TorqueSource::measured ? 0 : std::min(interval, kLongestHold);
}

bool has_slow_joint_sensor(const Log& log, const ArmModel& model, int k) {
  constexpr double kSlower = 1.5;
  constexpr double kOften = 0.02;
  if (model.nominal.joint[k].drive == Drive::none) return false;
  const SampledColumn sensor(log.time, log.joint_position[k]), motor(log.time, log.motor_position[k]);
  if (!sensor.is_there() || !motor.is_there()) return false;
  double longer = 0, samples = 0, last = std::numeric_limits<double>::infinity();
  bool motor_between = false;
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (std::isnan(log.joint_position[k][i])) {
      motor_between = motor_between || !std::isnan(log.motor_position[k][i]);
      continue;
    }
    // Where the encoder's readings are lost, too, or come late, the sensor is not slower than the encoder.
    longer += motor_between && log.time[i] - last > kSlower * motor.interval();
    samples += 1, last = log.time[i], motor_between = false;
  }
  return longer > kOften * samples;
}

std::vector<int> stuck_joint_sensors(const Log& log, const ArmModel& model) {
  constexpr double kMotion = 0.05;    // of the joint's range
  constexpr std::size_t kEvery = 10;  // rows
  const int n = log.n_joints;
  std::vector<int> stuck;
  for (int k = 0; k < n; ++k) {
    if (model.nominal.joint[k].drive == Drive::none || !never_changes(log.joint_position[k])) continue;
    std::vector<double> by_motors;
    Eigen::VectorXd q_m(n);  // the last readings; motors may be read in different rows
    for (int j = 0; j < n; ++j) q_m(j) = log.motor_position[j].empty() ? 0 : std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < log.size(); ++i) {
      for (int j = 0; j < n; ++j)
        if (!log.motor_position[j].empty() && std::isfinite(log.motor_position[j][i]))
          q_m(j) = log.motor_position[j][i];
      if (i % kEvery == 0) by_motors.push_back(unstretched_joints(model.nominal, q_m, model.home())(k));
    }
    const auto [low, high] = range_of(by_motors);
    if (high - low > kMotion * (model.joints[k].upper - model.joints[k].lower)) stuck.push_back(k);
  }
  return stuck;
}

std::vector<Record> make_records(const Log& given, const ArmModel& model, const RecordOptions& wanted) {
  if (given.size() < 2)
    throw InputError(given.source + ": has fewer than two samples; expected a record of at least a second");
  constexpr double kSlowest = 0.1;  // s a sample
  const double dt = SampledColumn(given.time, given.time).interval();
  if (dt > kSlowest * (1 + 1e-6))
    throw InputError(
        fmt::format("{}: a sample follows another after {:.4g} s; expected at least 10 samples a second; if its "
                    "time is not in s, say so by a column map, such as time=NAME,unit=ms",
                    given.source, dt));
  for (int k = 0; k < given.n_joints; ++k)
    if (model.nominal.joint[k].drive != Drive::none && given.motor_position[k].empty())
      throw InputError(fmt::format("{}: has no motor_position_{}; expected the angle of every motor of the model",
                                   given.source, k + 1));
  RecordOptions options = wanted;
  if (wanted.settle_s > 0) options.settle_s = settling_time(model, wanted.settle_s);
  const Log log = usable(given, model);
  const std::vector<Row> mark = mark_gaps(log, model, options.longest_gap_s);

  const double fastest = fastest_rate(model);
  std::vector<Record> records;
  for (std::size_t begin = 0, end = 0; begin < log.size(); begin = end) {
    for (end = begin + 1; end < log.size() && mark[end] == Row::goes_on;) ++end;
    if (mark[begin] == Row::lost || log.time[end - 1] - log.time[begin] < 1 + options.settle_s) continue;
    records.push_back(Stretch(slice(log, begin, end), model, options).record());
    records.back().most_stages = most_stages_for(fastest, records.back().dt);
    records.back().first_motion = start_of_motion(records.back(), model);
  }
  if (records.empty())
    throw InputError(
        fmt::format("{}: no stretch to learn from or to hold out is longer than {:.2g} s without gaps; expected a "
                    "longer record, or "
                    "a hold-out log of its own",
                    log.source, 1 + options.settle_s));
  return records;
}

}  // namespace halyard

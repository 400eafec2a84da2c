#include "diagnosis/record.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/input_error.h"

namespace halyard {
namespace {

/// Gaussian kernel of a cut-off and its first two derivatives on the sample grid, as correlation weights.
struct Kernel {
  std::vector<double> value, slope, curvature;   ///< [2 reach + 1]
  int reach;
};

Kernel gaussian_kernel(double cutoff_hz, double dt) {
  const double sigma_samples = 1 / (2 * std::numbers::pi * cutoff_hz * dt);
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

/// A column on the uniform grid, linear between its samples that are there; valid[i] is 1 where the
/// grid point lies within one sample of one.
std::vector<double> on_grid(const std::vector<double>& time, const std::vector<double>& x, double start, double dt,
                            std::size_t size, std::vector<double>* valid) {
  std::vector<double> t, v;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i])) t.push_back(time[i]), v.push_back(x[i]);
  std::vector<double> y(size, 0);
  if (valid) valid->assign(size, 0);
  if (t.empty()) return y;
  std::size_t j = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const double now = start + dt * static_cast<double>(i);
    while (j + 1 < t.size() && t[j + 1] <= now) ++j;
    if (j + 1 < t.size() && now > t[j])
      y[i] = v[j] + (v[j + 1] - v[j]) * (now - t[j]) / (t[j + 1] - t[j]);
    else
      y[i] = v[j];
    const double nearest = std::min(std::abs(now - t[j]), j + 1 < t.size() ? std::abs(t[j + 1] - now) : 1e300);
    if (valid) (*valid)[i] = nearest <= 1.01 * dt ? 1 : 0;
  }
  return y;
}

void keep_every(Record& r, std::size_t stride) {
  if (stride <= 1) return;
  for (Signals* signals : {&r.motor_angle, &r.motor_rate, &r.motor_acceleration, &r.torque, &r.joint, &r.joint_raw, &r.external,
                           &r.joint_valid, &r.torque_valid})
    for (std::vector<double>& x : *signals) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < x.size(); i += stride) x[kept++] = x[i];
      x.resize(kept);
    }
  r.size = (r.size + stride - 1) / stride;
  r.dt *= static_cast<double>(stride);
}

/// Takes out the samples about which the comparing kernel sees too few that are there.
void keep_comparable(std::vector<double>& valid, const std::vector<double>& kernel) {
  constexpr double kEnough = 0.95;   // of the kernel's weight
  const std::vector<double> there = valid;
  const auto size = static_cast<std::ptrdiff_t>(there.size()), reach = static_cast<std::ptrdiff_t>(kernel.size() / 2);
  for (std::ptrdiff_t i = 0; i < size; ++i) {
    double weight = 0;
    for (std::ptrdiff_t t = std::max<std::ptrdiff_t>(0, i - reach); t < std::min(size, i + reach + 1); ++t)
      weight += kernel[t - i + reach] * there[t];
    if (weight < kEnough) valid[i] = 0;
  }
}

Record make_record(const Log& log, const ArmModel& model, const RecordOptions& options, double dt) {
  Record r;
  r.n = log.n_joints;
  r.dt = dt;
  r.start = log.time.front();
  r.size = static_cast<std::size_t>(std::floor(log.duration() / dt + 0.5)) + 1;
  r.source = log.source;
  for (Signals* s : {&r.motor_angle, &r.motor_rate, &r.motor_acceleration, &r.torque, &r.joint, &r.joint_raw, &r.external,
                     &r.joint_valid, &r.torque_valid})
    s->resize(r.n);
  const Kernel kernel = gaussian_kernel(options.motion_hz, dt);
  const auto grid = [&](const std::vector<double>& x, std::vector<double>* valid = nullptr) {
    return on_grid(log.time, x, r.start, dt, r.size, valid);
  };
  const auto settled = static_cast<std::size_t>(options.settle_s / dt), reach = static_cast<std::size_t>(kernel.reach);

  for (int k = 0; k < r.n; ++k) {
    const JointParameters<double>& j = model.nominal.joint[k];
    r.torque_valid[k].assign(r.size, 0);
    r.joint_valid[k].assign(r.size, 0);
    std::vector<double> motor_there(r.size, 1);
    if (j.drive == Drive::none) {
      r.motor_angle[k] = r.motor_rate[k] = r.motor_acceleration[k] = std::vector<double>(r.size, 0.0);
    } else {
      const std::vector<double> angle = grid(log.motor_position[k], &motor_there);
      r.motor_angle[k] = correlate(angle, kernel.value, kernel.reach);
      r.motor_rate[k] = correlate(angle, kernel.slope, kernel.reach);
      r.motor_acceleration[k] = correlate(angle, kernel.curvature, kernel.reach);
      if (log.has_motor_torque(k)) {
        std::vector<double> torque_there;
        const std::vector<double> torque = correlate(grid(log.motor_torque[k], &torque_there), kernel.value, kernel.reach);
        r.torque[k].resize(r.size);
        for (std::size_t i = 0; i < r.size; ++i) {
          r.torque[k][i] = 0.5 * (torque[i] + torque[i > 0 ? i - 1 : 0]);
          // Near an end the filters see a signal that was made up.
          const bool inside = i >= reach && i + reach < r.size;
          r.torque_valid[k][i] = torque_there[i] * motor_there[i] * (i >= settled && inside);
        }
      }
    }
    if (log.has_joint_position(k)) {
      std::vector<double> there;
      r.joint_raw[k] = grid(log.joint_position[k], &there);
      r.joint[k] = correlate(r.joint_raw[k], kernel.value, kernel.reach);
      for (std::size_t i = 0; i < r.size; ++i) r.joint_valid[k][i] = there[i] * motor_there[i] * (i >= settled);
    }
    if (log.has_joint_torque(k)) r.external[k] = correlate(grid(log.joint_torque[k]), kernel.value, kernel.reach);
  }
  keep_every(r, static_cast<std::size_t>(std::max(1.0, std::floor(options.step_s / dt + 1e-6))));
  r.compare = {1};
  if (options.compare_hz > 0) r.compare = gaussian_kernel(options.compare_hz, r.dt).value;
  for (Signals* valid : {&r.joint_valid, &r.torque_valid})
    for (std::vector<double>& x : *valid) keep_comparable(x, r.compare);
  return r;
}

}  // namespace

std::vector<Record> make_records(const Log& log, const ArmModel& model, const RecordOptions& options) {
  if (log.size() < 2) throw InputError(log.source + ": has fewer than two samples; expected a record of at least a second");
  std::vector<double> steps;
  for (std::size_t i = 1; i < log.size(); ++i) steps.push_back(log.time[i] - log.time[i - 1]);
  std::nth_element(steps.begin(), steps.begin() + steps.size() / 2, steps.end());
  const double dt = steps[steps.size() / 2];

  std::vector<Record> records;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= log.size(); ++i) {
    if (i < log.size() && log.time[i] - log.time[i - 1] <= std::max(options.longest_gap_s, 1.5 * dt)) continue;
    const Log part = slice(log, begin, i);
    if (part.duration() >= 1 + options.settle_s) records.push_back(make_record(part, model, options, dt));
    begin = i;
  }
  if (records.empty())
    throw InputError(log.source + ": no stretch to learn from or to hold out is longer than 1.5 s without gaps; expected a longer record, or a "
                     "hold-out log of its own");
  return records;
}

std::pair<Log, Log> split_log(const Log& log, double fraction) {
  const double at = log.time.front() + fraction * log.duration();
  const auto middle = static_cast<std::size_t>(std::lower_bound(log.time.begin(), log.time.end(), at) - log.time.begin());
  return {slice(log, 0, middle), slice(log, middle, log.size())};
}

}  // namespace halyard

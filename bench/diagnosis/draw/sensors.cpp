#include "bench/diagnosis/draw/sensors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "transmission/effects/typical_size.h"

namespace halyard::blind {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// Linear between the rows.
double value_at(const std::vector<double>& time, const std::vector<double>& x, double t) {
  if (t <= time.front()) return x.front();
  if (t >= time.back()) return x.back();
  const auto after = static_cast<std::size_t>(std::ranges::upper_bound(time, t) - time.begin());
  const double share = (t - time[after - 1]) / (time[after] - time[after - 1]);
  return std::lerp(x[after - 1], x[after], share);
}

double rounded(double x, double resolution) { return resolution > 0 ? resolution * std::round(x / resolution) : x; }

/// A wrong reading by 50 to 500 counts.
double outlier(double resolution, Random& random) {
  return (random.chance(0.5) ? 1 : -1) * random.log_uniform(50, 500) * resolution;
}

std::vector<double> joint_column(const SensorDraw& s, const Log& exact, int k, double resolution, Random& random) {
  std::vector<double> column(exact.size(), kMissing);
  double next = exact.time.front();
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double t = exact.time[i];
    if (s.interval_s > 0 && t < next) continue;
    next += s.interval_s;
    // Drawn even where the reading is missing: what is missing then changes nothing else.
    const double instant = t - s.latency_s + s.jitter_s * random.normal(), noise = s.noise[k] * random.normal();
    const bool lost = random.chance(s.missing_share), wrong = random.chance(s.outlier_share);
    const bool in_stretch = std::ranges::any_of(
        s.missing, [&](const SensorDraw::Stretch& m) { return m.joint == k && t >= m.from_s && t < m.to_s; });
    if (lost || in_stretch) continue;
    const double q = value_at(exact.time, exact.joint_position[k], instant);
    column[i] = rounded(q + noise + (wrong ? outlier(resolution, random) : 0), resolution);
  }
  return column;
}

}  // namespace

SensorDraw draw_sensors(Sensors kind, const ArmModel& model, double from_s, double to_s, Random& random) {
  SensorDraw s = ideal_sensors(model);
  const bool good = kind == Sensors::good;
  s.sees_joints = kind != Sensors::motors;
  for (int k = 0; k < model.n(); ++k) {
    const JointParameters<double>& j = model.nominal.joint[k];
    s.noise[k] = random.uniform(0, good ? 1 : 30) * j.joint_encoder_resolution;
    if (j.drive != Drive::none) s.torque_noise[k] = random.uniform(0, good ? 0.02 : 0.2) * typical_motor_friction(j);
  }
  if (kind != Sensors::poor) return s;
  s.interval_s = 1 / random.log_uniform(30, 1000);
  s.latency_s = random.chance(0.5) ? random.uniform(0, 0.02) : 0;
  s.jitter_s = random.uniform(0, 0.1) * s.interval_s;
  s.missing_share = random.uniform(0, 0.05);
  for (int k = 0; k < model.n(); ++k)
    for (int i = random.below(3); i > 0; --i) {
      const double length = random.log_uniform(0.05, 1), start = random.uniform(from_s, to_s - length);
      s.missing.push_back({k, start, start + length});
    }
  return s;
}

SensorDraw ideal_sensors(const ArmModel& model) {
  SensorDraw s;
  s.noise.assign(model.n(), 0);
  s.torque_noise.assign(model.n(), 0);
  return s;
}

Log read_sensors(const SensorDraw& sensors, const Log& exact, const ArmModel& model, Random& random) {
  Log log = exact;
  for (int k = 0; k < model.n(); ++k) {
    if (sensors.torque_noise[k] > 0)
      for (double& torque : log.motor_torque[k]) torque += sensors.torque_noise[k] * random.normal();
    log.joint_position[k].clear();
    if (sensors.sees_joints)
      log.joint_position[k] = joint_column(sensors, exact, k, model.nominal.joint[k].joint_encoder_resolution, random);
  }
  return log;
}

}  // namespace halyard::blind

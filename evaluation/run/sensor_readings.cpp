#include "evaluation/run/sensor_readings.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "estimators/process/process_model.h"

namespace halyard {
namespace {

/// q'' at a sample: the slope of the velocity over 5 ms on either side, or to the next samples if these are farther. A
/// shorter span would show the noise of an estimate that differentiates encoders.
double acceleration(const std::vector<double>& time, const std::vector<double>& velocity, std::size_t at) {
  const auto reaches = [&](std::size_t i, bool is_next) {
    const double reach = is_next ? 0.05 : 0.005005;  // s; a hair more than five periods of 1 ms
    return std::abs(time[i] - time[at]) < reach && !std::isnan(velocity[i]);
  };
  std::size_t a = at, b = at;
  while (a > 0 && reaches(a - 1, a == at)) --a;
  while (b + 1 < time.size() && reaches(b + 1, b == at)) ++b;
  return b > a ? (velocity[b] - velocity[a]) / (time[b] - time[a]) : 0;
}

}  // namespace

Signals sensor_readings(const ArmModel& model, const EstimatorRun& run) {
  const ProcessModel process(model);
  const std::vector<double> unused(static_cast<std::size_t>(process.n_states()), 0.0);
  Signals readings = run.estimates.joint_position;
  for (std::size_t i = 0; i < run.estimates.size(); ++i) {
    JointSignals<double> s[kMaxJoints];
    for (int k = 0; k < model.n(); ++k) {
      s[k].joint_position = run.estimates.joint_position[k][i];
      s[k].joint_rate = run.estimates.joint_velocity[k][i];
      s[k].joint_acceleration = acceleration(run.estimates.time, run.estimates.joint_velocity[k], i);
    }
    process.transmission().sensor_errors(run.estimates.time[i], unused.data(), s);
    for (int k = 0; k < model.n(); ++k) readings[k][i] += s[k].joint_error;
  }
  return readings;
}

}  // namespace halyard

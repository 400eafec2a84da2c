#include "evaluation/run/sensor_readings.h"

#include <limits>
#include <vector>

#include "estimators/process/process_model.h"

namespace halyard {

Signals sensor_readings(const ArmModel& model, const EstimatorRun& run) {
  const ProcessModel process(model);
  const std::vector<double> unused(static_cast<std::size_t>(process.n_states()), 0.0);
  Signals readings = run.estimates.joint_position;
  for (std::size_t i = 0; i < run.estimates.size(); ++i) {
    JointSignals<double> s[kMaxJoints];
    for (int k = 0; k < model.n(); ++k) {
      s[k].joint_position = run.estimates.joint_position[k][i];
      s[k].joint_rate = run.estimates.joint_velocity[k][i];
    }
    process.transmission().sensor_errors(run.estimates.time[i], unused.data(), s);
    for (int k = 0; k < model.n(); ++k) readings[k][i] += s[k].joint_error;
  }
  return readings;
}

}  // namespace halyard

#include "estimators/log_sample.h"

#include <limits>

namespace halyard {

void read_row(const Log& log, std::size_t i, Sample& sample) {
  sample.time_s = log.time[i];
  sample.motor_torque.resize(log.n_joints);
  sample.motor_position.resize(log.n_joints);
  for (int k = 0; k < log.n_joints; ++k) {
    const std::vector<double>&torque = log.motor_torque[k], &position = log.motor_position[k];
    sample.motor_torque(k) = torque.empty() ? std::numeric_limits<double>::quiet_NaN() : torque[i];
    sample.motor_position(k) = position.empty() ? 0 : position[i];
  }
  sample.marker.resize(0);
  if (!log.has_marker()) return;
  const Eigen::Vector3d marker(log.marker[0][i], log.marker[1][i], log.marker[2][i]);
  if (marker.allFinite()) sample.marker = marker;
}

Sample sample_of(const Log& log, std::size_t i) {
  Sample sample;
  read_row(log, i, sample);
  return sample;
}

}  // namespace halyard

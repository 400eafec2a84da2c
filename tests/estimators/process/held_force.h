#pragma once
/// Noise levels of a model, and what a force of such a level does.

#include <cmath>

#include "estimators/process/noise.h"

namespace halyard {

inline NoiseLevels levels_of(const ArmModel& model, const ProcessModel& process, const EstimatorOptions& options = {}) {
  OptionReader reader("the test", options);
  return read_noise(reader, model, process);
}

/// What the noise of one source moves in a step from x, if it is held over the step. source: the motors' torques, then
/// the forces on the joints.
inline Eigen::VectorXd moved_by_held_force(const ProcessModel& process, const NoiseLevels& levels,
                                           const Eigen::VectorXd& x, double dt_s, int source) {
  const int n = process.n_joints();
  Eigen::VectorXd torque = Eigen::VectorXd::Zero(n), force = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd free = x, forced = x;
  process.advance({0, dt_s, torque.data(), force.data()}, free.data());
  (source < n ? torque(source) : force(source - n)) =
      std::sqrt(2 * levels.correlation_time / dt_s) *
      (source < n ? levels.torque(source) : levels.joint_force(source - n));
  process.advance({0, dt_s, torque.data(), force.data()}, forced.data());
  return forced - free;
}

}  // namespace halyard

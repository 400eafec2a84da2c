#pragma once
/// The arm and the motion that all benchmarks use.

#include "estimators/log_sample.h"
#include "model/model_file.h"
#include "plant/simulate.h"

namespace halyard {

inline ArmModel raven2() { return read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml"); }

/// Sines of all joints around home.
inline Scenario sines(const ArmModel& robot, double duration_s) {
  Scenario s;
  s.robot = robot;
  s.name = "benchmark";
  s.duration_s = duration_s;
  s.fade_in_s = 0.5;
  s.trajectory.resize(robot.n());
  for (int k = 0; k < robot.n(); ++k) {
    s.trajectory[k].kind = JointTrajectory::Kind::sines;
    s.trajectory[k].center = robot.joints[k].home;
    s.trajectory[k].sines = {{robot.nominal.joint[k].type == JointType::revolute ? 0.2 : 0.02, 0.5 + 0.2 * k, 0}};
  }
  return s;
}

inline std::vector<Sample> samples_of(const Log& log) {
  std::vector<Sample> samples(log.size());
  for (std::size_t i = 0; i < log.size(); ++i) samples[i] = sample_of(log, i);
  return samples;
}

}  // namespace halyard

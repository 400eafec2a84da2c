#pragma once
/// The first joints of the RAVEN-II in motion: arms small enough to be diagnosed within seconds.

#include "model/model_file.h"
#include "plant/scenario.h"

namespace halyard {

inline ArmModel first_joints(int n) {
  ArmModel model = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml");
  model.nominal.n = n;
  model.joints.resize(n);
  return model;
}

/// The arm on a few sines of each joint around home, under stiffer control than its own, so that it follows.
inline Scenario motion(const ArmModel& robot, double duration, int variant = 0) {
  Scenario s;
  s.robot = robot;
  s.name = "test";
  s.duration_s = duration;
  s.fade_in_s = 0.5;
  s.trajectory.resize(robot.n());
  for (int k = 0; k < robot.n(); ++k) {
    s.robot.joints[k].controller.kp *= 4;
    s.robot.joints[k].controller.kd *= 2;
    JointTrajectory& t = s.trajectory[k];
    t.kind = JointTrajectory::Kind::sines;
    t.center = robot.joints[k].home;
    t.sines = {{0.25, 0.31 + 0.07 * k, 0.3 * variant},
               {0.12, 0.83 - 0.09 * k, 1.0 + variant},
               {0.05, 1.7 + 0.21 * k, 2.0 - variant}};
  }
  return s;
}

}  // namespace halyard

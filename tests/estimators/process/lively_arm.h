#pragma once
/// An arm whose numbers are all of the order of one, so that no part of its equations hides behind another: friction,
/// curved cables, gravity and the forces of its own motion are alike in size.

#include "estimators/process/process_model.h"
#include "tests/support/arm_runs.h"
#include "tests/support/random_arm.h"

namespace halyard {

inline ArmModel lively_arm(CableLaw law = CableLaw::paper) {
  ArmModel model;
  model.name = "lively";
  model.nominal = random_arm(5, law);
  model.nominal.gravity[1] = 3;
  model.nominal.gravity[2] = -5;
  const double c = 0.6, s = 0.8;
  for (int k = 0; k < 3; ++k) {
    JointParameters<double>& j = model.nominal.joint[k];
    const double about_x[3][3] = {{1, 0, 0}, {0, c, -s}, {0, s, c}}, about_y[3][3] = {{c, 0, s}, {0, 1, 0}, {-s, 0, c}};
    for (int r = 0; r < 3; ++r) {
      for (int i = 0; i < 3; ++i) j.frame_R[r][i] = k == 1 ? about_y[r][i] : about_x[r][i];
      j.frame_p[r] = 0.3 + 0.1 * r - 0.2 * k;
    }
    j.motor_smoothing = 0.7;
    j.stiffness *= 0.5;
    model.joints.push_back({.name = "j", .lower = -1, .upper = 1, .home = 0.1 * k, .controller = {}, .tolerances = {}});
  }
  return model;
}

/// With a force at each motor or joint, and with cables that effects bend.
inline ArmModel lively_arm_with_effects() {
  ArmModel model = lively_arm();
  add_effect(model, "torque_ripple", 1, {0.3, -0.2, 2});
  add_effect(model, "motor_friction", 0, {0.2, 0.05, 0.1, -0.1});
  add_effect(model, "stiffness", 0, {1.2, 0.8, 5});
  add_effect(model, "backlash", 1, {0.1, 0.15});  // well rounded
  add_effect(model, "joint_friction", 2, {0.2, 0.05, 0.1, -0.1});
  return model;
}

/// In motion, with cables that are stretched.
inline Eigen::VectorXd lively_state(const ProcessModel& process) {
  const StateLayout& l = process.layout();
  const Eigen::Vector3d q(0.4, -0.3, 0.2), stretch(0.15, -0.2, 0.25), motor_rate(-0.9, 0.6, 0.4);
  Eigen::VectorXd x = process.state_at_rest(unstretched_motors(process.arm(), q), q);
  for (int k = 0; k < 3; ++k) {
    x(*l.motor_angle[k]) += stretch(k) / process.arm().joint[k].motor_travel();
    x(l.rate[k]) = 0.5 - 0.4 * k;
    x(*l.motor_rate[k]) = motor_rate(k);
  }
  return x;
}

}  // namespace halyard

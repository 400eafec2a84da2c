#pragma once

#include "model/arm_model.h"

namespace halyard {

/// One joint that hangs freely.
inline ArmModel pendulum() {
  ArmModel model;
  model.nominal.n = 1;
  JointParameters<double>& j = model.nominal.joint[0];
  j.drive = Drive::none;
  j.mass = 1;
  j.com[0] = 0.5;
  j.inertia[2] = 0.01;
  j.coupling[0] = 1;
  model.joints.resize(1);
  model.joints[0] = {.name = "pendulum", .lower = -2, .upper = 2, .home = 1, .controller = {}, .tolerances = {}};
  return model;
}

}  // namespace halyard

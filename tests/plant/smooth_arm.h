#pragma once
/// A moving arm whose forces are smooth functions of its state, for tests of the integrators.

#include "plant/integrators/integrator.h"
#include "tests/plant/integrator_names.h"
#include "tests/support/random_arm.h"

namespace halyard {

/// All numbers of the order of one.
inline ArmParameters<double> smooth_arm() {
  ArmParameters<double> arm = halyard::random_arm(5, CableLaw::paper);
  arm.gravity[0] = 3, arm.gravity[2] = -9;
  return arm;
}

/// A plant of this arm in motion under constant torques, and its state at the start.
struct SmoothMotion {
  ArmPlant plant{smooth_arm()};
  Eigen::VectorXd start = Eigen::VectorXd::Zero(plant.layout().size());

  SmoothMotion() {
    start.head(6) << 0.1, 0.2, 0.3, 0.5, 0.2, -0.1;
    const double command[] = {0.5, -0.3, 0.4}, no_load[] = {0, 0, 0};
    plant.set_inputs(0, command, no_load);
  }
};

}  // namespace halyard

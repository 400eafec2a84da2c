#pragma once
/// Initial state of a run: at rest, with the cables stretched so that they hold the arm.
///
///   R_cᵀ g = h(q) - other forces on the joints
///
/// This is solved for g. Then, for each cable drive, the motor angle q_m,k is found at which the cable's force
/// g_k(q_m,k) equals this g_k.

#include "plant/arm_plant.h"

namespace halyard {

/// State y at joint positions q. All rates and the effects' internal states are zero. The motor angles are those at
/// which each cable holds its joint; joints without a cable keep their position in q. Throws InputError with the
/// joint's name if no stretch up to 1 m holds it.
Eigen::VectorXd resting_state(ArmPlant& plant, double time_s, const Eigen::VectorXd& q);

}  // namespace halyard

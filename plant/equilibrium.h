#pragma once
/// Where a run starts: at rest, with the cables stretched so that they hold the arm.
///
///   R_cᵀ g = h(q) - other forces on the joints    solved for g, then g_k(q_m,k) = g_k for each motor

#include "plant/arm_plant.h"

namespace halyard {

/// y with q given, all rates zero, effects' internal states zero, and motor angles at which each cable holds its
/// joint. Joints without a cable stand where q puts them. Throws InputError naming the joint if no stretch up to a
/// metre holds it.
Eigen::VectorXd resting_state(ArmPlant& plant, double time_s, const Eigen::VectorXd& q);

}  // namespace halyard

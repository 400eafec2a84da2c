#pragma once
/// Faults of a whole arm that its numbers, each within its own bound, do not show.

#include <Eigen/Core>
#include <optional>

#include "transmission/arm_parameters.h"

namespace halyard {

/// The first joint, 0-based, that moves without inertia at these positions [n] while the joints inboard of it are free:
/// M(q) with the rotors' inertia is not positive definite there. None: every joint has an inertia.
std::optional<int> joint_without_inertia(const ArmParameters<double>& arm, const Eigen::VectorXd& q);

}  // namespace halyard

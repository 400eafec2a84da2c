#pragma once
/// The coupling of coupling.h as a matrix, and kinematics without elasticity.

#include <Eigen/Core>

#include "transmission/arm_parameters.h"

namespace halyard {

/// R [n x n]; row i of a joint without drive is kept, though no cable follows it.
Eigen::MatrixXd path_matrix(const ArmParameters<double>& arm);

/// Kinematics without elasticity (Eq. 8 inverted): the q [n] at which no driven cable is
/// stretched, for motor angles q_m [n]. A joint without drive is taken to stand at q_undriven.
/// Throws std::invalid_argument if R of the driven joints is singular.
Eigen::VectorXd unstretched_joints(const ArmParameters<double>& arm, const Eigen::VectorXd& q_m,
                                   const Eigen::VectorXd& q_undriven);

/// The motor angles at which no cable is stretched at joint position q (Eq. 8).
Eigen::VectorXd unstretched_motors(const ArmParameters<double>& arm, const Eigen::VectorXd& q);

}  // namespace halyard

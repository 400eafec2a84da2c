#pragma once
/// Where the joints come to rest when the motors are held, and joints without a motor are held where the search begins:
/// what holds them is not known. Friction carries no force there:
///
///   F(q) + Bᵀ λ = 0,   B q = b
///
///   F   joint force at rest: cables and external load, minus the force that holds the
///       arm against gravity                                                             [n]    N m | N
///   B   for each rigidly driven joint its row of the path matrix; for each joint
///       without a motor that of the unit matrix                                         [n_held x n]
///   b   travel of the rigid drive's motor; position of the joint without a motor        [n_held]  m; rad | m
///   λ   forces of the rigid transmissions; what holds the joints without motors         [n_held]  N; N m | N
///
/// Solved by pseudo-transient continuation, (M / δ - ∂F/∂q) Δq = F, with a step δ that grows as the force falls. Early
/// steps follow the force, so that they cross a backlash to the side on which the cable holds; late steps are Newton's
/// method. Source: Kelley and Keyes, SIAM J. Numer. Anal. 35 (1998).

#include "estimators/process/process_model.h"

namespace halyard {

/// The equilibrium q [n] for motor angles [n], an external joint force [n] and internal states of the effects z
/// [n_effect_states]; the search begins at `start` [n], where a joint without a motor stays. Throws std::runtime_error
/// if it finds no equilibrium, naming the joint with the largest residual force.
Eigen::VectorXd static_equilibrium(const ProcessModel& process, double time_s, const Eigen::VectorXd& motor_angle,
                                   const Eigen::VectorXd& external, const Eigen::VectorXd& z,
                                   const Eigen::VectorXd& start);

}  // namespace halyard

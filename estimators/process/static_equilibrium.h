#pragma once
/// Where the joints come to rest when the motors are held. Friction carries no force there:
///
///   F(q) + R_rᵀ λ = 0,   R_r q = s_r
///
///   F     joint force at rest: cables and external load, minus the force that holds
///         the arm against gravity                                                       [n]    N m | N
///   R_r   rows of the path matrix that belong to rigidly driven joints                  [n_rigid x n]
///   s_r   travel of their motors                                                        [n_rigid]  m
///   λ     forces of the rigid transmissions                                             [n_rigid]  N
///
/// Solved by pseudo-transient continuation, (M / δ - ∂F/∂q) Δq = F, with a step δ that grows as the force falls. Early
/// steps follow the force, so that they cross a backlash to the side on which the cable holds; late steps are Newton's
/// method. Source: Kelley and Keyes, SIAM J. Numer. Anal. 35 (1998).

#include "estimators/process/process_model.h"

namespace halyard {

/// The equilibrium q [n] for motor angles [n], an external joint force [n] and internal states of the effects z
/// [n_effect_states]; the search begins at `start` [n]. Throws std::runtime_error if it finds no equilibrium, naming
/// the joint with the largest residual force.
Eigen::VectorXd static_equilibrium(const ProcessModel& process, double time_s, const Eigen::VectorXd& motor_angle,
                                   const Eigen::VectorXd& external, const Eigen::VectorXd& z,
                                   const Eigen::VectorXd& start);

}  // namespace halyard

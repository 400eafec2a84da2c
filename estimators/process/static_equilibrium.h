#pragma once
/// Where the joints come to rest when the motors are held: friction is at rest and carries nothing,
///
///   F(q) + R_rᵀ λ = 0,   R_r q = s_r
///
///   F     joint force at rest: cables, external load, less gravity's holding force      [n]    N m | N
///   R_r   rows of the path matrix of rigidly driven joints, s_r their motors' travel    [n_rigid x n], m
///   λ     forces of the rigid transmissions                                             [n_rigid]  N
///
/// by pseudo-transient continuation, (M / δ - ∂F/∂q) Δq = F with a step δ that grows as the force falls: at first it
/// follows the force, so that it crosses a backlash to the side on which the cable holds, at last it is Newton's
/// method. Source: Kelley and Keyes, SIAM J. Numer. Anal. 35 (1998).

#include "estimators/process/process_model.h"

namespace halyard {

/// The equilibrium q [n] for motor angles q_m [n] and an external joint force [n], from `start` on, with internal
/// states of the effects z [n_effect_states]. Throws std::runtime_error naming the joint with the largest rest of
/// force if there is none within reach.
Eigen::VectorXd static_equilibrium(const ProcessModel& process, double time_s, const Eigen::VectorXd& motor_angle,
                                   const Eigen::VectorXd& external, const Eigen::VectorXd& z,
                                   const Eigen::VectorXd& start);

}  // namespace halyard

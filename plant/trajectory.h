#pragma once
/// Desired motion of the joints.
///
///   hold            q = center
///   sines           q = center + p(t / t_fade) Σ A sin(2π f t + φ)
///   point_to_point  from points[0] to points[1] and so on, repeated until the run ends; each move takes move_s along
///                   q = a + (b - a) p(t / move_s), then the joint rests for dwell_s
///   samples         linear between samples, constant outside
///
///   p(s) = 10 s³ - 15 s⁴ + 6 s⁵: minimum jerk (Flash and Hogan 1985)

#include "plant/scenario.h"

namespace halyard {

/// Throws InputError, without file and line, for a trajectory that cannot be followed: no points, no samples, moves of
/// 0 s or less, negative dwells, a move with its dwell below 1e-6 s, or sample times that do not increase.
void check_trajectory(const JointTrajectory& trajectory);

double desired_position(const JointTrajectory& trajectory, double fade_in_s, double time_s);

}  // namespace halyard

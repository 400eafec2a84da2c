#pragma once
/// What the joints are asked to do.
///
///   hold            q = center
///   sines           q = center + f(t / t_fade) Σ A sin(2π f t + φ)
///   point_to_point  from points[0] to points[1] and on, over again until the run ends; each move takes move_s along
///                   q = a + (b - a) f(t / move_s) and is followed by dwell_s of rest
///   samples         linear between samples, held outside
///
///   f(s) = 10 s³ - 15 s⁴ + 6 s⁵: minimum jerk (Flash and Hogan 1985)

#include "plant/scenario.h"

namespace halyard {

/// Throws InputError, without a place, for a trajectory that cannot be followed: too few points or samples, times of
/// samples or durations that do not increase.
void check_trajectory(const JointTrajectory& trajectory);

double desired_position(const JointTrajectory& trajectory, double fade_in_s, double time_s);

}  // namespace halyard

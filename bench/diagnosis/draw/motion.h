#pragma once
/// Random motions that a controller can follow: what a blind trial records.
///
///   sines           2 to 4 of 0.1 to 1 Hz, each weighed by 1/f; 7 of 10 joints
///   point_to_point  3 to 5 points, moves of 0.7 s and longer, rests of 0.2 to 0.8 s; the rest
///
/// The center lies in the middle half of the joint's range, the reach is 40 to 90 % of what is left around it. Sines
/// are made smaller, and moves slower, until the acceleration stays below 6 rad/s² or 0.6 m/s²: the motors have no
/// torque for more.

#include "diagnosis/rehearsal/random.h"
#include "plant/scenario.h"

namespace halyard::blind {

/// [n] Joints.
std::vector<JointTrajectory> random_motion(const ArmModel& model, Random& random);

/// What the trajectory asks for from `from_s` to `to_s`: positions in rad or m, the largest speed in rad/s or m/s.
struct Travel {
  double least, most, fastest;
};
Travel travel_of(const JointTrajectory& trajectory, double fade_in_s, double from_s, double to_s);

}  // namespace halyard::blind

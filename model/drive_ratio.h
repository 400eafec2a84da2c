#pragma once
/// How far the ratio of a drive may be off.
///
///   q_l = r_m / (N r_l) q_m       r_m capstan radius, N gear ratio, r_l pulley radius
///
/// Three lengths may each be off by ArmModel's tolerance of lengths, and the ratio by their sum. Only the ratio can be
/// told from a log, so that one number, the capstan's radius, stands for all three (identify, diagnose).

#include "model/arm_model.h"

namespace halyard {

/// The number of these lengths that may be off. One that is 1 stands for no such part: a drive without a gear, or
/// whose cable pulls along the axis of a prismatic joint.
inline int uncertain_lengths(const JointParameters<double>& joint) {
  return (joint.gear_ratio != 1) + (joint.capstan_radius != 1) + (joint.pulley_radius != 1);
}

/// The sum of the tolerances of the lengths, m: how far the capstan's radius may be off when it stands for them.
inline double reach_of_ratio(const ArmModel& model, int joint) {
  const JointParameters<double>& j = model.nominal.joint[joint];
  return model.joints[joint].tolerances.length * uncertain_lengths(j) * j.capstan_radius;
}

}  // namespace halyard

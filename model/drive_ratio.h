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

/// True for each of the three lengths.
inline bool is_of_ratio(const ParameterInfo& number) {
  return number.key.ends_with(".gear_ratio") || number.key.ends_with(".capstan_radius") ||
         number.key.ends_with(".pulley_radius");
}

/// ArmModel::reach(), but the capstan's radius stands for the ratio: it has the sum of the lengths' tolerances, and the
/// gear ratio and the pulley's radius have 0.
inline double reach_with_one_ratio(const ArmModel& model, const ParameterInfo& number) {
  if (!is_of_ratio(number)) return model.reach(number);
  if (!number.key.ends_with(".capstan_radius")) return 0;
  return model.reach(number) * uncertain_lengths(model.nominal.joint[number.joint]);
}

}  // namespace halyard

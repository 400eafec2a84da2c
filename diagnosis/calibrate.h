#pragma once
/// Scales of recorded torques that the model says nothing of (tolerance torque_scale of 1 or more): a current or a
/// voltage instead of a torque. They are told before anything is searched, so that a scale that is wrong by any factor
/// is a start as good as another; the fits then refine it.
///
///   κ = cov(u, τ) / var(u)     over the samples in which the motor moves
///
///   u   recorded torque, in whatever unit        τ   torque that the motion needs, by the model, N m

#include "diagnosis/record.h"

namespace halyard {

/// The model with its unknown torque scales. Throws InputError if a torque does not go with its motor's motion, or goes
/// against it.
ArmModel calibrated(const ArmModel& model, const std::vector<Record>& records);

/// True if a number of named_parameters() is a torque scale that the model does not know.
bool is_unknown_scale(const ArmModel& model, int named_parameter);

}  // namespace halyard

#pragma once
/// Estimates torque scales that the model does not know (tolerance torque_scale of 1 or more), for logs with a current
/// or a voltage instead of a torque. This is done before the search, so that the scale in the model file may be wrong
/// by any factor. The fits then refine it.
///
///   κ = cov(u, τ) / var(u)     over the samples in which the motor moves
///
///   u   recorded torque, any unit        τ   torque that the motion requires according to the model, N m

#include "diagnosis/record/record.h"

namespace halyard {

/// The model with its unknown torque scales estimated. Throws InputError if a torque is not correlated with its motor's
/// motion. check_log() finds wrong signs before.
ArmModel calibrated(const ArmModel& model, const std::vector<Record>& records);

/// True if an entry of named_parameters() is a torque scale that the model does not know.
bool is_unknown_scale(const ArmModel& model, std::size_t named_parameter);

}  // namespace halyard

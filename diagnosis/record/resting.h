#pragma once
/// Tells the samples of a record at which a motor rests.

#include "diagnosis/record/record.h"

namespace halyard {

/// True if motor k stands still for most of what the comparing kernel sees about sample `at`: friction then has any
/// value that balance asks for. A motor that reverses without a stop does not rest. For a joint without a motor the
/// joint's own motion counts.
///   v_s  rad/s: below 2 v_s the model's friction has not reached its level. Decisions take slowest_smoothing() of the
///        joint, so that they do not rely on the model's own value; reported errors take the model's motor_smoothing
bool rests(const Record& record, int k, std::size_t at, double v_s);

/// motor_smoothing of joint k, or the smallest that its tolerance admits, but at least a tenth: with a model's own
/// value that is too large, the samples that show a smaller one would not count.
double slowest_smoothing(const ArmModel& model, int k);

}  // namespace halyard

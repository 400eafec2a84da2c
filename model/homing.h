#pragma once
/// Zeros of encoders that count from where they were switched on.

#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

/// Takes the zero off the encoders whose zero the model does not know (motor_offset="unknown", joint_offset="unknown"):
/// the median, over the first second of the log, of reading less what the other side says through an unstretched
/// transmission. What the cables stretch meanwhile is left in it. Homing a log twice changes nothing.
///
/// Throws InputError if the log has not the sensors that tell the zero.
void home_encoders(Log& log, const ArmModel& model);

}  // namespace halyard

#pragma once
/// Unknown zeros of encoders, such as those that count from zero at power-on.

#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

/// Subtracts the zero from each encoder whose zero the model does not know (motor_offset="unknown",
/// joint_offset="unknown"). The zero is the median, over the first second of the log, of the reading minus the value
/// computed from the other side's encoders through an unstretched transmission. Cable stretch during that second
/// remains as an error. Homing a log twice changes nothing.
///
/// Throws InputError if the log lacks the sensors that determine the zero.
void home_encoders(Log& log, const ArmModel& model);

}  // namespace halyard

#pragma once
/// Unknown zeros of encoders, such as those that count from zero at power-on.

#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

/// Subtracts the zero from each encoder whose zero the model does not know (motor_offset="unknown",
/// joint_offset="unknown"). At each reading of the joint's sensor in the first second in which the encoders on both
/// sides of the transmission have readings, the expected reading is computed from those on the other side, with
/// unstretched cables and the changes that the model's effects make to the arm.
/// The zero is the median of reading minus expected reading. Cable stretch during that second remains as an error.
/// Homing a log twice changes nothing.
///
/// Throws InputError if the log lacks the sensors that determine the zero.
void home_encoders(Log& log, const ArmModel& model);

}  // namespace halyard

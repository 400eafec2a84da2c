#pragma once
/// Whether a record begins while the arm moves, as after a hole of a log, or at rest.

#include "diagnosis/record/record.h"

namespace halyard {

/// Of the motors; rates and accelerations from their angles in the first kRunIn. Nothing if they rest, or if the joints
/// do not move with them. Where joints have sensors, they tell: a motor that falls into its slack cable as a controller
/// is switched on moves fast, but its joint does not. Where they have none, the motors must have moved before, too, if
/// their acceleration was the same.
StartOfMotion start_of_motion(const Record& record, const ArmModel& model);

}  // namespace halyard

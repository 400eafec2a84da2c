#pragma once
/// The ratio κ by which a torque residual is divided, so that it is in units of the measured torque.
///
///   κ = std(torque after the command stage) / std(commanded torque)

#include "diagnosis/prediction/prediction.h"

namespace halyard {

/// κ of motor k under a hypothesis, at least 0.05 times the motor's torque_scale. If the command never changes, it is
/// the torque_scale. history: the record's commands.
double acting_over_commanded(const Record& record, const Hypothesis& h, int k, const CommandHistory& history);

}  // namespace halyard

#pragma once
/// The checks of a log, in their order. Each adds its findings.

#include "diagnosis/log_check/log_under_check.h"

namespace halyard {

/// Times that do not increase, wrong units, gaps, missing rows and jitter.
void check_clock(LogUnderCheck& c);

/// Counters that wrap around, and an arm that stands still.
void check_counters(LogUnderCheck& c);

/// Frozen and saturated position sensors, jumps and outliers. Runs after check_positions(), on corrected units.
void check_columns(LogUnderCheck& c);

/// Joint readings against the motors' angles: swapped columns, ratios, units, signs. The sense
/// of the motor's torque tells a motor's sign from a joint sensor's.
void check_positions(LogUnderCheck& c);

/// Torques at the end of their range. Runs after check_torques(), on corrected units: the model's torque_limit is no
/// finding.
void check_clipped_torques(LogUnderCheck& c);

/// Recorded torques against those that the motion requires: swapped columns, signs, units.
void check_torques(LogUnderCheck& c);

/// Positions outside their range, and columns that are late.
void check_zeros(LogUnderCheck& c);
void check_delays(LogUnderCheck& c);

/// Whether motor k's recorded torque goes with (1), opposes (-1) or does not tell (0) the torque that its motion
/// requires, [n].
std::vector<int> torque_senses(const LogUnderCheck& c);

}  // namespace halyard

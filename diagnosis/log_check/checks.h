#pragma once
/// The checks of a log, in their order. Each adds its findings.

#include "diagnosis/log_check/log_under_check.h"

namespace halyard {

/// Times that do not increase, wrong units, gaps, missing rows and jitter.
void check_clock(LogUnderCheck& c);

/// Logs that are too short for a diagnosis, or have more samples a second than a controller takes, as in a wrong unit
/// of time. Estimators run over them.
void check_length(LogUnderCheck& c);

/// Counters that wrap around, and an arm that stands still.
void check_counters(LogUnderCheck& c);

/// Frozen and saturated position sensors, jumps and outliers. Runs after check_positions(), on corrected units.
void check_columns(LogUnderCheck& c);

/// Joint readings against the motors' angles: ratios, units, signs. If a sign is wrong, the sense of the motor's torque
/// decides whether it is the motor's or the joint sensor's. Runs after the checks of exchanged positions (exchanges.h).
void check_positions(LogUnderCheck& c);

/// Torques at the end of their range. Torques that stop at the model's torque_limit are not reported. Runs after
/// check_torques(), because this comparison needs corrected units.
void check_clipped_torques(LogUnderCheck& c);

/// Torques that stay the same while their motor moves. Runs after check_positions(), on corrected units.
void check_frozen_torques(LogUnderCheck& c);

/// Single torques of an impossible size.
void check_torque_spikes(LogUnderCheck& c);

/// Recorded torques against those that the motion requires: exchanged columns (exchanges.h), signs, units.
void check_torques(LogUnderCheck& c);

/// Positions outside their range, and columns that are late.
void check_zeros(LogUnderCheck& c);
void check_delays(LogUnderCheck& c);

/// For each motor k, [n]: 1 if the recorded torque goes with the torque that the motor's motion requires, -1 if it
/// opposes that torque, 0 if the log does not show which.
std::vector<int> torque_senses(const LogUnderCheck& c);

}  // namespace halyard

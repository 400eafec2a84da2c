#pragma once
/// Recorded torques beside those that the motion of a log under check requires.

#include <optional>

#include "diagnosis/calibration/torque_comparison.h"
#include "diagnosis/log_check/log_under_check.h"
#include "diagnosis/log_check/robust.h"

namespace halyard {

/// Part by part: a comparison needs many times the memory of its part. Nothing if no part of the log is long enough;
/// diagnose() says so itself.
std::optional<TorqueComparison> needed_torques(const LogUnderCheck& c);

/// The correlation of a recorded torque with a needed one if it is significant for its number of independent samples; 0
/// otherwise.
Correlation significant(const LogUnderCheck& c, const TorqueComparison& t, int recorded, int needed);

/// The share of a torque's variance that does not go with what a motion needs.
double unexplained(const Correlation& r);

/// Whether the model knows the torque's unit.
bool has_known_scale(const LogUnderCheck& c, int k);

}  // namespace halyard

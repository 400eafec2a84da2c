#pragma once

#include <vector>

#include "diagnosis/log_check/log_check.h"

namespace halyard {

/// The findings of check_log() about the times of a log of two samples or more: an order or a unit that is wrong, gaps,
/// jitter. For commands that learn nothing from the other columns, and would take milliseconds for seconds.
std::vector<LogFinding> check_times(const Log& log, const ArmModel& model, const ColumnMap& columns);

}  // namespace halyard

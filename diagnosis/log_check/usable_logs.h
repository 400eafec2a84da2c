#pragma once
/// The logs of a diagnosis as it uses them: checked, without repeated readings and without outliers.

#include <optional>
#include <vector>

#include "diagnosis/log_check/log_check.h"

namespace halyard {

struct UsableLogs {
  std::vector<Log> training;
  std::optional<Log> holdout;
  std::vector<LogFinding> findings;  ///< of check_log() about all logs, then the repeated readings that were left out
};

/// columns: the map with which the logs were read. Throws InputError if check_log() has a gross finding about one of
/// them.
UsableLogs usable_logs(const ArmModel& model, std::vector<Log> training, std::optional<Log> holdout,
                       const ColumnMap& columns);

}  // namespace halyard

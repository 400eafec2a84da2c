#pragma once
/// The readings that a position sensor has taken. A logger whose rows are faster than the sensor may repeat the last
/// reading until the next one; compared as it is, such a column lags behind by half its interval.
///
/// A run of equal readings is repeated, and not rounded, if the next reading differs by more than three of the sensor's
/// steps. A column repeats its readings if more than half of its way lies in such changes. Of each run its first row is
/// kept. At rest a sensor reads the same again: of a longer run, rows are kept at the sensor's usual interval.
///
/// A joint that stands behind backlash or friction has equal readings as well, but then sets out slowly.

#include <optional>
#include <vector>

#include "diagnosis/log_check/log_check.h"

namespace halyard {

/// A sensor whose readings were repeated.
struct RepeatedReadings {
  Signals Log::*signal = nullptr;
  int joint = 0;        ///< 0-based
  double interval = 0;  ///< usual time from a reading to the next, s
};

/// The log as the diagnosis takes it: without repeated readings and without outliers. findings: gets one for each
/// sensor whose readings were repeated.
Log usable_readings(Log log, const ArmModel& model, std::vector<LogFinding>* findings = nullptr);

struct UsableLogs {
  std::vector<Log> training;
  std::optional<Log> holdout;
  std::vector<LogFinding> findings;  ///< of check_log() about all logs, then those of usable_readings()
};

/// The logs of a diagnosis, checked and as it takes them. columns: the map with which they were read. Throws InputError
/// if check_log() has a gross finding about one of them.
UsableLogs usable_logs(const ArmModel& model, std::vector<Log> training, std::optional<Log> holdout,
                       const ColumnMap& columns);

/// Empties the cells that repeat a motor's position or a joint's, and torques that are repeated with their motor's.
std::vector<RepeatedReadings> keep_own_readings(Log& log, const ArmModel& model);

}  // namespace halyard

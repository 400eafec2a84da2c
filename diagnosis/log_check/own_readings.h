#pragma once
/// The readings that a joint sensor has taken. A logger whose rows are faster than the sensor may repeat the last reading
/// until the next one; compared as it is, such a column lags behind the joint by half its interval.
///
/// A run of equal readings is repeated, and not rounded, if meanwhile the motors lead the joint by more than three of the
/// sensor's steps. A column repeats its readings if more than half of the joint's way lies in such runs. Of each run its
/// first row is kept. At rest a sensor reads the same again: of a longer run, rows are kept at the sensor's usual interval.
///
/// A joint that does not follow its motor, because of backlash or friction, has equal readings as well, but goes most of
/// its way.

#include <vector>

#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

/// A joint sensor whose readings were repeated.
struct RepeatedReadings {
  int joint = 0;        ///< 0-based
  double interval = 0;  ///< usual time from a reading to the next, s
};

/// The log as the diagnosis takes it: without repeated readings and without outliers.
Log usable_readings(Log log, const ArmModel& model);

/// Empties the cells that repeat a reading of a joint sensor. Joints without a motor and logs without motors' positions
/// stay as they are.
std::vector<RepeatedReadings> keep_own_readings(Log& log, const ArmModel& model);

}  // namespace halyard

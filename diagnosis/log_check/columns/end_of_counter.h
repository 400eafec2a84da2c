#pragma once
/// A position that often stops abruptly at the same extreme value: a counter or a converter at its end.
///
/// A motor that comes to rest slows down before, and one that turns round at its extreme is slow there. A counter that
/// ends has the motor's speed until the last sample before the stop, and again from the first one after. So a stop is
/// abrupt if on both sides of it
///
///   v > u / 2,   where u is the speed above which the motor is for a tenth of the time
///
/// or, however slow the motor is where its counter ends,
///
///   v > v' / 2   and   2 e > D / 4   and   e > 20 c,   e = v T / 4
///
///   v, v'  speed in the few samples beside the stop, and in twice as many beyond them       unit/s
///   T      duration of the stop                                                             s
///   e      way beyond the end of a motion that turns round evenly within T                  unit
///   D      usual |x(t + T/2) - 2 x(t) + x(t - T/2)| of the column: 2 e where it turns so    unit
///   c      step of the sensor                                                               unit
///
/// The second rule is for motors. Friction stops a joint abruptly, but where the motor moves on, its reading is
/// compared with the motor's.

#include "diagnosis/log_check/columns/column_samples.h"

namespace halyard {

/// Tells it if there are two such stops, and more than half of those at the value.
void check_end_of_counter(LogUnderCheck& c, const PositionColumn& column);

}  // namespace halyard

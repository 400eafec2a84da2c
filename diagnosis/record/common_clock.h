#pragma once
/// One clock for all training logs of a diagnosis. Each log counts its own time. The instants of effects are counted on
/// the common clock, so that a push or a slip of one log happens in no other.
///
///   t_common = t + Record::clock_shift
///
/// The first log keeps its clock. A later log is shifted only if it would overlap the logs before it.

#include "diagnosis/prediction/prediction.h"

namespace halyard {

/// Seconds to add to the times of each log: [log].
std::vector<double> clock_shifts(const std::vector<Log>& logs);

/// The hypothesis with the instants of its effects on the record's own clock.
Hypothesis on_own_clock(const Record& record, Hypothesis h);

/// The record in which an event happens: the one that it overlaps most, or the nearest. Null for an effect that is no
/// event.
const Record* record_of(const PlacedEffect& effect, const ArmParameters<double>& arm,
                        const std::vector<Record>& records);

/// The effect with its instants, if it has any, on the clock of the log in which it happens.
PlacedEffect on_clock_of_its_log(PlacedEffect effect, const ArmParameters<double>& arm,
                                 const std::vector<Record>& records);

/// The hypothesis with each of its effects from index `first` on the clock of the log in which it happens.
Hypothesis on_clocks_of_their_logs(Hypothesis h, std::size_t first, const ArmParameters<double>& arm,
                                   const std::vector<Record>& records);

}  // namespace halyard

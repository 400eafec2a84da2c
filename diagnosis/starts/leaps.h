#pragma once
/// Instants at which a residual jumps, candidates for sudden events such as a slip of a cable.
///
///   z_ci = |e_ci - e_c,i-1| / (median of such steps of channel c  √(Δt_i / Δt))
///
///   e_ci   residual of fitting row i of channel c      Δt_i, Δt   time since the row before, and the row interval
///
/// A search over a grid of instants would need steps of tens of milliseconds, the period of the arm's vibrations.

#include "diagnosis/fit/evidence.h"

namespace halyard {

/// Instants around each of the strongest jumps, ascending, s. One of them is at most half a row from the jump. If
/// deciding blocks lie between its rows, two dozen instants are spread over these blocks, however long they are.
/// rows: residuals of the fitting rows.
std::vector<double> leaps(const Evidence& evidence, const std::vector<double>& rows);

}  // namespace halyard

#pragma once
/// Instants at which a residual leaps: where something happened at once, a cable that slipped say, it happened there.
///
///   z_ci = |e_ci - e_c,i-1| / (median of such steps of channel c  √(Δt_i / Δt))
///
///   e_ci   residual of fitting row i of channel c      Δt_i, Δt   from the row before it, and between neighbours
///
/// A search over a grid of instants would have to be as fine as the arm rings to see them: tens of milliseconds.

#include "diagnosis/evidence.h"

namespace halyard {

/// Around each of the strongest leaps, instants so close that one of them is at most half a row off, or two dozen where
/// rows of deciding blocks lie between, s; ascending. rows: residuals of the fitting rows.
std::vector<double> leaps(const Evidence& evidence, const std::vector<double>& rows);

}  // namespace halyard

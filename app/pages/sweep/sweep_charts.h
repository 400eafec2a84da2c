#pragma once
/// Curves of a sweep, for its page and its pictures.

#include <string>

#include "app/report/chart.h"
#include "evaluation/sweep/sweep_grid.h"
#include "evaluation/sweep/sweep_summary.h"

namespace halyard {

/// Whether values of these ends need a logarithmic axis to be read.
bool spans_decades(double least, double greatest, double decades);

/// "joint1.cable.stiffness [N/m]"
std::string axis_label(const SweepAxis& axis);

/// The chart of a joint's errors over an axis, still without curves.
report::Chart empty_chart(const SweepGrid& grid, const SweepSummary& summary, const SweepAxis& axis, std::size_t k);

/// A curve with the intervals of its places, if one of them has several points.
report::Series series_of(const std::string& name, const SweepSummary::Curve& curve, double shown_per_si);

/// Mean absolute error of a joint over the a-th axis, averaged over everything else that varies.
report::Chart mean_chart(const SweepGrid& grid, const SweepSummary& summary, std::size_t a, std::size_t k);

}  // namespace halyard

#pragma once
/// Curves of a sweep, for its page and its pictures.

#include <cstddef>
#include <string>
#include <vector>

#include "app/report/chart.h"
#include "evaluation/sweep/sweep_grid.h"
#include "evaluation/sweep/sweep_summary.h"

namespace halyard {

/// Whether values of these ends need a logarithmic axis to be read.
bool spans_decades(double least, double greatest, double decades);

/// "joint1.cable.stiffness [N/m]"
std::string axis_label(const SweepAxis& axis);

/// Indices of the measures that pictures show.
std::vector<std::size_t> shown_measures(const SweepGrid& grid);
/// Number of charts of a measure side by side: one for each joint, or one for all.
std::size_t n_charts(const SweepGrid& grid, std::size_t m);
/// "Joint 2", or "All joints"
std::string joint_title(const SweepGrid& grid, std::size_t m, std::size_t k);

/// "joint 2" of "Joint 2"
std::string lower_case(std::string title);

/// The chart of the m-th measure of a joint over an axis, still without curves.
report::Chart empty_chart(const SweepGrid& grid, const SweepSummary& summary, const SweepAxis& axis, std::size_t m,
                          std::size_t k);

/// A curve with the intervals of its places, if one of them has several points.
report::Series series_of(const std::string& name, const SweepSummary::Curve& curve, double shown_per_si);

/// The charts of the m-th measure over the a-th axis, averaged over everything else that varies.
std::vector<report::Chart> mean_charts(const SweepGrid& grid, const SweepSummary& summary, std::size_t m,
                                       std::size_t a);

}  // namespace halyard

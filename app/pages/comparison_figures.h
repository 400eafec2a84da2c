#pragma once
/// The parts of a report that show a comparison. Joint indices are 0-based in arguments and 1-based in reports;
/// positions and errors are shown in degrees or millimetres.

#include <cstddef>
#include <optional>
#include <string>

#include "app/report/chart.h"
#include "app/report/page.h"
#include "evaluation/comparison/compare.h"

namespace halyard {

/// "1.234 deg" without the unit; "-" for NaN.
std::string shown_number(double si_value, const JointUnit& unit);
/// "36.8 %"; "-" for NaN.
std::string shown_percent(double fraction);

/// Truth, where known, and every estimate over time.
report::Chart trajectory_chart(const Comparison& comparison, int k);
/// Estimate minus truth over time, of all runs but `left_out`, if one is given.
report::Chart error_chart(const Comparison& comparison, int k, std::optional<std::size_t> left_out = std::nullopt);
/// Share of the counted samples by error, of the same runs.
report::Chart error_histogram(const Comparison& comparison, int k, std::optional<std::size_t> left_out = std::nullopt);
/// One row per joint and estimator; the least mean absolute error of a joint is marked.
report::Table error_table(const Comparison& comparison);

/// For every joint: a heading "<prefix>Joint 1", the trajectories, and the errors if the truth is known. If the errors
/// of kinematics hide those of the others, the error charts are repeated without kinematics.
void add_joint_figures(report::Page& page, const Comparison& comparison, const std::string& prefix = "");

}  // namespace halyard

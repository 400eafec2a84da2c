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

/// The number in the displayed unit, but without the name of the unit: "1.234" for 1.234 deg; "-" for NaN.
std::string shown_number(double si_value, const JointUnit& unit);
/// "36.8 %"; "-" for NaN.
std::string shown_percent(double fraction);

/// Truth, where known, and every estimate over time.
report::Chart trajectory_chart(const Comparison& comparison, int k);
/// Estimate minus truth over time, of all runs but `left_out`, if one is given.
report::Chart error_chart(const Comparison& comparison, int k, std::optional<std::size_t> left_out = std::nullopt);
/// Histogram of the errors of the same runs, in shares of the counted samples.
report::Chart error_histogram(const Comparison& comparison, int k, std::optional<std::size_t> left_out = std::nullopt);
/// One row per joint and estimator; the smallest mean absolute error of a joint is marked.
report::Table error_table(const Comparison& comparison);

/// For every joint: a heading "<prefix>Joint 1", the trajectories, and the errors if the truth is known. If the errors
/// of kinematics hide those of the others, the error charts are repeated without kinematics.
void add_joint_figures(report::Page& page, const Comparison& comparison, const std::string& prefix = "");

}  // namespace halyard

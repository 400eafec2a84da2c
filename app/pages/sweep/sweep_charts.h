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

/// A row of charts, one for each joint or one for all: a measure of all estimators, or of one effect.
struct ChartRow {
  std::size_t measure = 0;
  std::vector<std::size_t> subjects = {};  ///< of the grid
  std::size_t charts = 0;
};
/// The rows that show what the sweep measured.
std::vector<ChartRow> chart_rows(const SweepGrid& grid);

/// "Joint 2", or "All joints"
std::string joint_title(const SweepGrid& grid, const ChartRow& row, std::size_t k);
/// "joint 2" of "Joint 2"
std::string lower_case(std::string title);
/// "mean absolute error [deg]"
std::string value_label(const SweepGrid& grid, const ChartRow& row, std::size_t k);
/// Whether the values of a row at this joint need a logarithmic axis.
bool has_log_values(const SweepSummary& summary, const ChartRow& row, std::size_t k);

/// The chart of a joint over an axis, still without curves.
report::Chart empty_chart(const SweepGrid& grid, const SweepSummary& summary, const SweepAxis& axis,
                          const ChartRow& row, std::size_t k);

/// What the band around a mean is.
enum class BandKind {
  interval,  ///< the 95 % interval of the mean, of points that differ by chance
  range      ///< from the least to the greatest value, of points that differ because other parameters do
};

/// A curve with a band over its places, if one of them has several points.
report::Series series_of(const std::string& name, const SweepSummary::Curve& curve, double shown_per_si, BandKind kind);

/// The bands of mean_charts(). Samples differ by chance, the points of a grid do not.
BandKind band_of_means(const SweepGrid& grid);
/// The charts of a row over the a-th axis, averaged over everything else that varies.
std::vector<report::Chart> mean_charts(const SweepGrid& grid, const SweepSummary& summary, const ChartRow& row,
                                       std::size_t a);

}  // namespace halyard

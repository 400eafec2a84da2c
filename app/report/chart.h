#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace halyard::report {

enum class ChartKind {
  line,       ///< points joined in the order given; x need not increase (loops)
  scatter,    ///< points without lines
  bar,        ///< one group of bars per category, one bar per series
  histogram,  ///< bars on a numeric axis; x is the evenly spaced bin centre
};

/// An interval around a series, such as ± 2 standard deviations; drawn in line charts.
struct Band {
  std::vector<double> lower;  ///< has the length of x
  std::vector<double> upper;  ///< has the length of x
};

/// A number that is not finite is a gap.
struct Series {
  std::string name = {};       ///< text in the legend; empty: not in the legend
  std::vector<double> x = {};  ///< in the unit of the chart's x label; empty for ChartKind::bar
  /// in the unit of the y label; has the length of x, or, for ChartKind::bar, the length of `categories`
  std::vector<double> y = {};
  bool dashed = false;
  std::optional<Band> band = std::nullopt;
  /// index in the palette of 8 colours; none: the index of the series in the chart
  std::optional<std::size_t> colour = std::nullopt;
};

/// An interval of the x axis, shaded over the whole height. Infinite ends reach the chart's edge.
struct Region {
  double from = 0;
  double to = 0;
  std::string label;
};

struct Chart {
  std::string title = {};
  std::string x_label = {};  ///< with unit: "time [s]"
  std::string y_label = {};
  ChartKind kind = ChartKind::line;
  std::vector<Series> series = {};           ///< later ones are drawn on top
  std::vector<std::string> categories = {};  ///< ChartKind::bar only
  std::vector<Region> regions = {};
  bool log_x = false;  ///< values <= 0 become gaps
  bool log_y = false;
  int height_px = 320;
};

/// "#0072B2": the colour of a series at this place of a chart.
const char* colour_of(const Series& series, std::size_t place);

/// Where the band of a line ends below its point j: with a logarithmic axis at a tenth of the point at least, since it
/// may reach 0.
double lower_end(const Series& series, std::size_t j, bool is_logarithmic);

/// Throws std::invalid_argument, naming chart and series, if the lengths of the series do not match.
void check_lengths(const Chart& chart, const Series& series);

struct Points {
  std::vector<double> x, y;
};

/// Lines with more points are decimated to this number; scatters are thinned to twice this number.
inline constexpr std::size_t kDrawnPoints = 1500;

/// Divides the samples, in the order given, into max_points / 4 equal buckets. Of each bucket it keeps the samples with
/// the smallest and largest x and y (the first of equals), so that no peak is lost. A bucket with a gap also keeps the
/// gap. Returns all samples if there are at most max_points.
/// Throws std::invalid_argument if x and y differ in length or max_points < 4.
Points decimate(std::span<const double> x, std::span<const double> y, std::size_t max_points = kDrawnPoints);

/// Thins the points of a scatter. Keeps evenly spaced samples, so that the density is preserved, and the extremes of a
/// few long intervals, so that no outlier is lost. Returns all samples if there are at most max_points.
/// Throws std::invalid_argument if x and y differ in length or max_points < 200.
Points thin(std::span<const double> x, std::span<const double> y, std::size_t max_points = 2 * kDrawnPoints);

struct Sample {
  std::string name;
  std::vector<double> values;
};

/// Histogram of each sample in percent, over common bins from the smallest to the largest value; values that are not
/// finite do not count. Throws std::invalid_argument if bins is 0.
Chart histogram(std::string title, std::string x_label, const std::vector<Sample>& samples, std::size_t bins);

/// The input of page.js: decimated series, numbers to 12 significant digits, gaps as null. Safe inside a script
/// element, because it contains no '<'. Throws std::invalid_argument, naming chart and series, if lengths do not match.
std::string to_json(const Chart& chart);

}  // namespace halyard::report

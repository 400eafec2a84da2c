#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace halyard::report {

enum class ChartKind {
  line,       ///< points joined in the order given; x need not increase (loops)
  scatter,    ///< points alone
  bar,        ///< one group of bars per category, one bar per series
  histogram,  ///< bars on a numeric axis; x is the evenly spaced bin centre
};

/// An interval around a series, such as ± 2 standard deviations; drawn in line charts.
struct Band {
  std::vector<double> lower;  ///< as long as x
  std::vector<double> upper;  ///< as long as x
};

/// A number that is not finite is a gap.
struct Series {
  std::string name = {};       ///< legend; empty: not listed there
  std::vector<double> x = {};  ///< unit as the chart's x label says; empty for ChartKind::bar
  std::vector<double> y = {};  ///< unit as the chart's y label says; as long as x, for ChartKind::bar as the categories
  bool dashed = false;
  std::optional<Band> band = std::nullopt;
  std::optional<std::size_t> colour = std::nullopt;  ///< place in the palette of 8; otherwise the series' own place
};

/// A stretch of the x axis shaded over the whole height. Infinite ends reach the chart's edge.
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

struct Points {
  std::vector<double> x, y;
};

/// Longer lines are decimated to this many points, longer scatters thinned to twice as many.
inline constexpr std::size_t kDrawnPoints = 1500;

/// Cuts the samples, in the order given, into max_points / 4 equal buckets and keeps of each the samples with the
/// least and greatest x and y (first of equals), so that no peak is lost. A bucket with a gap keeps one more
/// sample, the gap. Not more than max_points samples: all of them.
/// Throws std::invalid_argument if x and y differ in length or max_points < 4.
Points decimate(std::span<const double> x, std::span<const double> y, std::size_t max_points = kDrawnPoints);

/// For scatters, where extremes alone would hollow out the cloud: evenly spaced samples, so that the density stays
/// fair, and the extremes of a few long stretches, so that no outlier is lost. Not more than max_points samples: all.
/// Throws std::invalid_argument if x and y differ in length or max_points < 200.
Points thin(std::span<const double> x, std::span<const double> y, std::size_t max_points = 2 * kDrawnPoints);

struct Sample {
  std::string name;
  std::vector<double> values;
};

/// Shares of each sample in percent, over common bins from the least to the greatest value; values that are not
/// finite do not count. Throws std::invalid_argument if bins is 0.
Chart histogram(std::string title, std::string x_label, const std::vector<Sample>& samples, std::size_t bins);

/// What page.js draws, series decimated, numbers to 12 significant digits, gaps as null. Safe inside a script
/// element: no '<' is in it. Throws std::invalid_argument, naming chart and series, if lengths do not match.
std::string to_json(const Chart& chart);

}  // namespace halyard::report

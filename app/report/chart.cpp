#include "app/report/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace halyard::report {

namespace {

using Indices = std::vector<std::size_t>;

void check(std::size_t nx, std::size_t ny, std::size_t max_points, std::size_t least) {
  if (nx != ny) {
    throw std::invalid_argument("cannot decimate " + std::to_string(nx) + " x with " + std::to_string(ny) + " y");
  }
  if (max_points < least) {
    throw std::invalid_argument("cannot decimate to " + std::to_string(max_points) + " points, at least " +
                                std::to_string(least));
  }
}

/// First gap and extremes of each bucket; not sorted, some twice.
Indices extremes(std::span<const double> x, std::span<const double> y, std::size_t buckets) {
  Indices indices;
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    const std::size_t end = (bucket + 1) * x.size() / buckets;
    std::optional<std::size_t> gap, x_min, x_max, y_min, y_max;
    for (std::size_t i = bucket * x.size() / buckets; i < end; ++i) {
      if (!std::isfinite(x[i]) || !std::isfinite(y[i])) {
        if (!gap) gap = i;
        continue;
      }
      if (!x_min || x[i] < x[*x_min]) x_min = i;
      if (!x_max || x[i] > x[*x_max]) x_max = i;
      if (!y_min || y[i] < y[*y_min]) y_min = i;
      if (!y_max || y[i] > y[*y_max]) y_max = i;
    }
    for (const auto& index : {gap, x_min, x_max, y_min, y_max}) {
      if (index) indices.push_back(*index);
    }
  }
  return indices;
}

Points pick(std::span<const double> x, std::span<const double> y, Indices indices) {
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  Points points;
  for (const std::size_t i : indices) {
    points.x.push_back(x[i]);
    points.y.push_back(y[i]);
  }
  return points;
}

}  // namespace

const char* colour_of(const Series& series, std::size_t place) {
  // Okabe and Ito's palette, colour-blind safe; yellow, pale on white, last.
  constexpr std::array<const char*, 8> kPalette = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                   "#56B4E9", "#E69F00", "#000000", "#F0E442"};
  return kPalette[series.colour.value_or(place) % kPalette.size()];
}

double lower_end(const Series& s, std::size_t j, bool is_logarithmic) {
  const double lower = s.band->lower[j];
  return is_logarithmic && s.y[j] > 0 && lower < s.y[j] / 10 ? s.y[j] / 10 : lower;
}

void check_lengths(const Chart& chart, const Series& series) {
  const bool bar = chart.kind == ChartKind::bar;
  const std::size_t expected = bar ? chart.categories.size() : series.x.size();
  const auto check = [&](std::size_t length, const char* what) {
    if (length == expected) return;
    throw std::invalid_argument("chart \"" + chart.title + "\", series \"" + series.name +
                                "\": " + std::to_string(length) + " values of " + what + ", expected " +
                                std::to_string(expected) + ", one per " + (bar ? "category" : "x"));
  };
  check(series.y.size(), "y");
  if (!series.band) return;
  check(series.band->lower.size(), "band.lower");
  check(series.band->upper.size(), "band.upper");
}

Points decimate(std::span<const double> x, std::span<const double> y, std::size_t max_points) {
  check(x.size(), y.size(), max_points, 4);
  if (x.size() <= max_points) return {{x.begin(), x.end()}, {y.begin(), y.end()}};
  return pick(x, y, extremes(x, y, max_points / 4));
}

Points thin(std::span<const double> x, std::span<const double> y, std::size_t max_points) {
  constexpr std::size_t stretches = 25, per_stretch = 5;
  check(x.size(), y.size(), max_points, 200);
  if (x.size() <= max_points) return {{x.begin(), x.end()}, {y.begin(), y.end()}};
  Indices indices = extremes(x, y, stretches);
  const std::size_t spaced = max_points - stretches * per_stretch;
  for (std::size_t i = 0; i < spaced; ++i) indices.push_back(i * x.size() / spaced);
  return pick(x, y, std::move(indices));
}

Chart histogram(std::string title, std::string x_label, const std::vector<Sample>& samples, std::size_t bins) {
  if (bins == 0) throw std::invalid_argument("histogram \"" + title + "\": needs at least one bin");

  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Sample& sample : samples) {
    for (const double value : sample.values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  const bool empty = low > high;
  if (low == high) {  // one value: bins around it
    const double half = low == 0 ? 0.5 : 0.5 * std::abs(low);
    low -= half;
    high += half;
  }
  const double width = (high - low) / static_cast<double>(bins);

  Chart chart{.title = std::move(title),
              .x_label = std::move(x_label),
              .y_label = "share of samples [%]",
              .kind = ChartKind::histogram};
  for (const Sample& sample : samples) {
    Series& series = chart.series.emplace_back(Series{.name = sample.name});
    if (empty) continue;
    std::vector<std::size_t> counts(bins, 0);
    std::size_t total = 0;
    for (const double value : sample.values) {
      if (!std::isfinite(value)) continue;
      ++counts[std::min(bins - 1, static_cast<std::size_t>((value - low) / width))];
      ++total;
    }
    for (std::size_t bin = 0; bin < bins; ++bin) {
      series.x.push_back(low + (static_cast<double>(bin) + 0.5) * width);
      series.y.push_back(total == 0 ? 0 : 100.0 * static_cast<double>(counts[bin]) / static_cast<double>(total));
    }
  }
  return chart;
}

}  // namespace halyard::report

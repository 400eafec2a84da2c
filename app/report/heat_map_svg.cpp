#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "app/report/figure_svg.h"
#include "app/report/svg_axis.h"
#include "app/report/svg_text.h"

namespace halyard::report {
namespace {

constexpr double kSide = 200;                                       // of a map
constexpr double kLeft = 88, kTop = 40, kRight = 92, kBottom = 52;  // around it
constexpr double kScaleGap = 12, kScaleWidth = 12;
constexpr int kScaleSteps = 64, kMostNames = 6;

/// Five colours of viridis (Smith and van der Walt, 2015), which is as even to readers with colour blindness; linear
/// between.
std::string colour_at(double place) {
  constexpr std::array<std::array<double, 3>, 5> kStops = {
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double at = std::clamp(place, 0.0, 1.0) * (kStops.size() - 1);
  const auto below = std::min<std::size_t>(std::size_t(at), kStops.size() - 2);
  std::array<int, 3> mixed{};
  for (std::size_t c = 0; c < 3; ++c)
    mixed[c] = int(std::lround(std::lerp(kStops[below][c], kStops[below + 1][c], at - double(below))));
  return fmt::format("#{:02x}{:02x}{:02x}", mixed[0], mixed[1], mixed[2]);
}

std::string rectangle(double x, double y, double width, double height, const std::string& fill) {
  return fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" "
      "shape-rendering=\"crispEdges\"/>\n",
      x, y, width, height, fill);
}

/// Names of every so many cells along an axis, from its middle on.
std::string names(const std::vector<double>& values, const auto& place) {
  const std::size_t stride = (values.size() + kMostNames - 1) / kMostNames;
  std::vector<double> named;
  for (std::size_t i = 0; i < values.size(); i += stride) named.push_back(values[i]);
  const std::vector<std::string> texts = svg_numbers(named);
  std::string svg;
  for (std::size_t i = 0; i < named.size(); ++i)
    svg += place((double(i * stride) + 0.5) / double(values.size()), texts[i]);
  return svg;
}

std::string scale_of_colours(const HeatMap& map, const SvgAxis& axis, double left, double top) {
  std::string svg;
  const double x = left + kSide + kScaleGap;
  for (int i = 0; i < kScaleSteps; ++i)
    svg += rectangle(x, top + kSide * (1 - (i + 1.0) / kScaleSteps), kScaleWidth, kSide / kScaleSteps + 0.5,
                     colour_at((i + 0.5) / kScaleSteps));
  const std::vector<double> ticks = axis.ticks();
  const std::vector<std::string> texts = svg_numbers(ticks);
  for (std::size_t i = 0; i < ticks.size(); ++i)
    svg += svg_text(x + kScaleWidth + 4, top + kSide * (1 - axis.place(ticks[i])) + 4, Anchor::start, texts[i]);
  return svg + svg_text(left + kSide + kRight - 8, top + kSide / 2, Anchor::middle, map.value_label, "", true);
}

std::string heat_map(const HeatMap& map, double left, double top) {
  if (map.value.size() != map.x.size() * map.y.size() || map.value.empty())
    throw std::invalid_argument("heat map \"" + map.title + "\": its values are not as many as its cells");
  const SvgAxis axis(map.value, map.log_value, false);
  const double width = kSide / double(map.x.size()), height = kSide / double(map.y.size());
  std::string svg = rectangle(left, top, kSide, kSide, "#eceef1");  // what shows where a cell is empty
  for (std::size_t i = 0; i < map.value.size(); ++i) {
    const double place = axis.place(map.value[i]);
    if (std::isnan(place)) continue;
    svg += rectangle(left + double(i % map.x.size()) * width, top + kSide - double(i / map.x.size() + 1) * height,
                     width + 0.3, height + 0.3, colour_at(place));
  }
  svg += names(map.x, [&](double place, const std::string& text) {
    return svg_text(left + place * kSide, top + kSide + 16, Anchor::middle, text);
  });
  svg += names(map.y, [&](double place, const std::string& text) {
    return svg_text(left - 6, top + (1 - place) * kSide + 4, Anchor::end, text);
  });
  svg += svg_text(left, top - 10, Anchor::start, map.title, " font-weight=\"bold\"");
  svg += svg_text(left + kSide / 2, top + kSide + 36, Anchor::middle, map.x_label,
                  fitted_size(map.x_label, kSide + kRight));
  svg += svg_text(left - 70, top + kSide / 2, Anchor::middle, map.y_label,
                  fitted_size(map.y_label, kSide + kTop + kBottom), /*turned=*/true);
  return svg + scale_of_colours(map, axis, left, top);
}

}  // namespace

std::string heat_map_svg(const std::vector<std::vector<HeatMap>>& rows) {
  std::size_t columns = 0;
  std::string svg;
  double top = kTop;
  for (const std::vector<HeatMap>& row : rows) {
    columns = std::max(columns, row.size());
    for (std::size_t k = 0; k < row.size(); ++k)
      svg += heat_map(row[k], kLeft + double(k) * (kLeft + kSide + kRight), top);
    top += kSide + kBottom + kTop;
  }
  if (columns == 0) throw std::invalid_argument("a picture without maps");
  return svg_document(double(columns) * (kLeft + kSide + kRight), top - kTop, svg);
}

}  // namespace halyard::report

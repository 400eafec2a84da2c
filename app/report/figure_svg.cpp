#include "app/report/figure_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/report/svg_axis.h"
#include "app/report/svg_text.h"

namespace halyard::report {
namespace {

constexpr double kWidth = 220, kHeight = 165;                       // of a panel
constexpr double kLeft = 78, kTop = 26, kRight = 18, kBottom = 52;  // around it
constexpr double kLegendLine = 20;

/// A panel with its axes, and the places of its points.
struct Panel {
  const Chart& chart;
  double left, top;
  SvgAxis x, y;

  std::string point(double at_x, double at_y) const {
    const double px = x.place(at_x), py = std::clamp(y.place(at_y), 0.0, 1.0);
    if (!std::isfinite(px) || !std::isfinite(py)) return "";
    return fmt::format("{:.1f},{:.1f} ", left + px * kWidth, top + (1 - py) * kHeight);
  }

  std::string frame() const {
    std::string svg;
    const std::vector<double> x_ticks = x.ticks(), y_ticks = y.ticks();
    const std::vector<std::string> x_texts = svg_numbers(x_ticks), y_texts = svg_numbers(y_ticks);
    for (std::size_t i = 0; i < x_ticks.size(); ++i) {
      const double at = left + x.place(x_ticks[i]) * kWidth;
      svg += fmt::format("<path d=\"M {:.1f} {:.1f} v {}\" stroke=\"#e3e6eb\"/>\n", at, top, kHeight);
      svg += svg_text(at, top + kHeight + 16, Anchor::middle, x_texts[i]);
    }
    for (std::size_t i = 0; i < y_ticks.size(); ++i) {
      const double at = top + (1 - y.place(y_ticks[i])) * kHeight;
      svg += fmt::format("<path d=\"M {:.1f} {:.1f} h {}\" stroke=\"#e3e6eb\"/>\n", left, at, kWidth);
      svg += svg_text(left - 6, at + 4, Anchor::end, y_texts[i]);
    }
    svg +=
        fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#9aa3b0\"/>\n",
                    left, top, kWidth, kHeight);
    svg += svg_text(left, top - 8, Anchor::start, chart.title, " font-weight=\"bold\"");
    svg += svg_text(left + kWidth / 2, top + kHeight + 36, Anchor::middle, chart.x_label,
                    fitted_size(chart.x_label, kWidth + 2 * kRight));
    return svg + svg_text(left - 60, top + kHeight / 2, Anchor::middle, chart.y_label,
                          fitted_size(chart.y_label, kHeight + kTop + kBottom), /*turned=*/true);
  }

  std::string series(std::size_t i) const {
    const Series& s = chart.series[i];
    std::string lines, line, upper, lower;
    const auto end_line = [&] {
      if (line.empty()) return;
      const std::size_t comma = line.find(','), end = line.find(' ');
      if (end + 1 == line.size())  // a line of one point would not show
        lines += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"1.8\" fill=\"{}\"/>\n", line.substr(0, comma),
                             line.substr(comma + 1, end - comma - 1), colour_of(s, i));
      else
        // Later curves are thinner, so that equal ones all show.
        lines += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{:.1f}\"{} points=\"{}\"/>\n",
                             colour_of(s, i), 1.4 + 0.7 * double(std::min<std::size_t>(chart.series.size() - 1 - i, 4)),
                             s.dashed ? " stroke-dasharray=\"6 4\"" : "", line);
      line.clear();
    };
    for (std::size_t j = 0; j < s.x.size(); ++j) {
      const std::string next = point(s.x[j], s.y[j]);
      if (next.empty()) end_line();  // a gap
      line += next;
      if (!s.band) continue;
      const std::string up = point(s.x[j], s.band->upper[j]), low = point(s.x[j], lower_end(s, j, chart.log_y));
      if (up.empty() || low.empty()) continue;
      upper += up;
      lower = low + lower;
    }
    end_line();
    if (upper.empty()) return lines;
    return fmt::format("<polygon fill=\"{}\" fill-opacity=\"0.18\" points=\"{}{}\"/>\n", colour_of(chart.series[i], i),
                       upper, lower) +
           lines;
  }
};

Panel panel_of(const Chart& chart, double left, double top) {
  std::vector<double> x, y;
  for (const Series& s : chart.series) {
    x.insert(x.end(), s.x.begin(), s.x.end());
    y.insert(y.end(), s.y.begin(), s.y.end());
    if (!s.band) continue;
    for (std::size_t j = 0; j < s.y.size(); ++j) y.push_back(lower_end(s, j, chart.log_y));
    y.insert(y.end(), s.band->upper.begin(), s.band->upper.end());
  }
  return {chart, left, top, SvgAxis(x, chart.log_x, false), SvgAxis(y, chart.log_y, true)};
}

/// The names of all series once each; returns the height that they take.
double add_legend(std::string& svg, const std::vector<std::vector<Chart>>& rows, double width) {
  std::vector<std::string> met;
  double x = kLeft, y = kLegendLine;
  for (const std::vector<Chart>& row : rows)
    for (const Chart& chart : row)
      for (std::size_t i = 0; i < chart.series.size(); ++i) {
        const std::string& name = chart.series[i].name;
        if (name.empty() || std::ranges::find(met, name) != met.end()) continue;
        met.push_back(name);
        const double length = 48 + kSvgLetter * double(name.size());
        if (x > kLeft && x + length > width) x = kLeft, y += kLegendLine;
        svg += fmt::format("<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"22\" height=\"4\" fill=\"{}\"/>\n", x, y - 2,
                           colour_of(chart.series[i], i));
        svg += svg_text(x + 27, y + 4, Anchor::start, name);
        x += length;
      }
  return met.empty() ? 0 : y + 10;
}

}  // namespace

std::string figure_svg(const std::vector<std::vector<Chart>>& rows) {
  std::size_t columns = 0;
  for (const std::vector<Chart>& row : rows) columns = std::max(columns, row.size());
  if (columns == 0) throw std::invalid_argument("a picture without charts");
  const double width = double(columns) * (kLeft + kWidth + kRight);
  std::string svg;
  double top = add_legend(svg, rows, width) + kTop;
  for (const std::vector<Chart>& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      for (const Series& series : row[k].series) check_lengths(row[k], series);
      const Panel panel = panel_of(row[k], kLeft + double(k) * (kLeft + kWidth + kRight), top);
      svg += panel.frame();
      for (std::size_t i = 0; i < row[k].series.size(); ++i) svg += panel.series(i);
    }
    top += kHeight + kBottom + kTop;
  }
  return svg_document(width, top - kTop, svg);
}

}  // namespace halyard::report

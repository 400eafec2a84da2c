#include "bench/performance/diagram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace halyard {
namespace {

constexpr double kWidth = 250, kHeight = 190, kLeft = 60, kTop = 50, kGap = 50;   // of a panel, and around it
constexpr int kLeastError = -11, kMostError = -3, kLeastWork = 0, kMostWork = 5;  // powers of ten
constexpr const char* kColours[] = {"#c0392b", "#2471a3", "#1e8449", "#b9770e",
                                    "#7d3c98", "#5d6d7e", "#000000", "#d98880"};

double x_of(double error) {
  return kWidth * (std::clamp(std::log10(error), double(kLeastError), double(kMostError)) - kLeastError) /
         (kMostError - kLeastError);
}
double y_of(double work) {
  return kHeight * (kMostWork - std::clamp(std::log10(work), double(kLeastWork), double(kMostWork))) /
         (kMostWork - kLeastWork);
}

std::string frame(const Panel& panel) {
  std::string svg = fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n", kWidth, kHeight);
  svg += fmt::format("<text x=\"0\" y=\"-6\">stiffness x{}, smoothing x{}</text>\n", panel.which.stiffness,
                     panel.which.smoothing);
  for (int e = kLeastError + 1; e < kMostError; e += 3)
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y2=\"{1}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"{2}\" "
        "text-anchor=\"middle\">1e{3}</text>\n",
        x_of(std::pow(10, e)), kHeight, kHeight + 14, e);
  for (int w = kLeastWork; w <= kMostWork; ++w)
    svg += fmt::format(
        "<line y1=\"{0:.1f}\" y2=\"{0:.1f}\" x2=\"{1}\" stroke=\"#ddd\"/><text x=\"-4\" y=\"{2:.1f}\" "
        "text-anchor=\"end\">1e{3}</text>\n",
        y_of(std::pow(10, w)), kWidth, y_of(std::pow(10, w)) + 4, w);
  return svg;
}

std::string curve(const WorkPrecision& result, const char* colour) {
  std::string points, marks;
  for (const WorkPoint& p : result.points) {
    points += fmt::format("{:.1f},{:.1f} ", x_of(p.error), y_of(p.work_ms));
    marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"/>", x_of(p.error), y_of(p.work_ms),
                         colour);
  }
  return fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" points=\"{}\"/>{}\n", colour, points,
                     marks);
}

}  // namespace

std::string diagram_svg(const std::string& title, const std::vector<Panel>& panels, std::size_t columns) {
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  const double width = kLeft + double(columns) * (kWidth + kGap), bottom = kTop + 20 + double(rows) * (kHeight + kGap),
               height = bottom + 30;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" font-size=\"11\" "
      "fill=\"#1c2430\">\n<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n<text x=\"{}\" y=\"24\" "
      "font-size=\"15\">{}: error [rad | m] to the right, ms of processor time a simulated second upwards</text>\n",
      width, height, width, height, kLeft, title);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    svg += fmt::format("<g transform=\"translate({},{})\">\n", kLeft + double(i % columns) * (kWidth + kGap),
                       kTop + 15 + double(i / columns) * (kHeight + kGap));
    svg += frame(panels[i]);
    for (std::size_t k = 0; k < panels[i].results.size(); ++k)
      svg += curve(panels[i].results[k], kColours[k % std::size(kColours)]);
    svg += "</g>\n";
  }
  const std::vector<std::string> names = compared_integrators();
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double x = kLeft + double(k) * (width - kLeft) / double(names.size());
    svg += fmt::format("<rect x=\"{:.0f}\" y=\"{}\" width=\"14\" height=\"4\" fill=\"{}\"/>", x, bottom,
                       kColours[k % std::size(kColours)]);
    svg += fmt::format("<text x=\"{:.0f}\" y=\"{}\">{}</text>\n", x + 18, bottom + 6, names[k]);
  }
  return svg + "</svg>\n";
}

}  // namespace halyard

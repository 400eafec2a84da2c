#include "app/report/svg_text.h"

#include <fmt/core.h>

#include <cmath>

namespace halyard::report {
namespace {

std::string escaped(std::string_view words) {
  std::string text;
  for (const char c : words) {
    if (c == '&') text += "&amp;";
    else if (c == '<') text += "&lt;";
    else if (c == '>') text += "&gt;";
    else text += c;
  }
  return text;
}

}  // namespace

std::string svg_text(double x, double y, Anchor anchor, std::string_view words, std::string_view more, bool turned) {
  const char* at = anchor == Anchor::start ? "start" : anchor == Anchor::middle ? "middle" : "end";
  const std::string place = turned ? fmt::format("transform=\"translate({:.1f},{:.1f}) rotate(-90)\"", x, y)
                                   : fmt::format("x=\"{:.1f}\" y=\"{:.1f}\"", x, y);
  return fmt::format("<text {} text-anchor=\"{}\"{}>{}</text>\n", place, at, more, escaped(words));
}

std::string svg_number(double value) {
  if (value == 0 || (std::abs(value) >= 1e-3 && std::abs(value) < 1e5)) return fmt::format("{:.3g}", value);
  const auto power = int(std::floor(std::log10(std::abs(value)) + 1e-9));
  return fmt::format("{:.3g}e{}", value / std::pow(10, power), power);
}

std::string svg_document(double width, double height, const std::string& content) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" "
      "font-size=\"12\" fill=\"#1c2430\">\n<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n{2}</svg>\n",
      width, height, content);
}

}  // namespace halyard::report

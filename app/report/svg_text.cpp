#include "app/report/svg_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/report/escaped.h"

namespace halyard::report {
namespace {

/// To so many significant digits.
std::string number_text(double value, int digits) {
  if (value == 0) return "0";
  const auto power = int(std::floor(std::log10(std::abs(value)) + 1e-9));
  if (power < -3 || power >= 5) return fmt::format("{:.{}g}e{}", value / std::pow(10, power), digits, power);
  std::string text = fmt::format("{:.{}f}", value, std::max(0, digits - 1 - power));
  if (text.find('.') == text.npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

std::string svg_text(double x, double y, Anchor anchor, std::string_view words, std::string_view more, bool turned) {
  const char* at = anchor == Anchor::start ? "start" : anchor == Anchor::middle ? "middle" : "end";
  const std::string place = turned ? fmt::format("transform=\"translate({:.1f},{:.1f}) rotate(-90)\"", x, y)
                                   : fmt::format("x=\"{:.1f}\" y=\"{:.1f}\"", x, y);
  return fmt::format("<text {} text-anchor=\"{}\"{}>{}</text>\n", place, at, more, escaped(words));
}

std::vector<std::string> svg_numbers(std::span<const double> values) {
  constexpr int kFewest = 3, kMost = 15;
  std::vector<std::string> texts;
  for (int digits = kFewest; digits <= kMost; ++digits) {
    texts.clear();
    for (const double value : values) texts.push_back(number_text(value, digits));
    const bool all_differ =
        std::set(texts.begin(), texts.end()).size() == std::set(values.begin(), values.end()).size();
    if (all_differ) break;
  }
  return texts;
}

std::string svg_document(double width, double height, const std::string& content) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" "
      "font-size=\"12\" fill=\"#1c2430\">\n<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n{2}</svg>\n",
      width, height, content);
}

}  // namespace halyard::report

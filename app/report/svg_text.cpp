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
  if (!std::isfinite(value)) return "-";
  if (value == 0) return "0";
  const std::string scientific = fmt::format("{:.{}e}", value, digits - 1);  // "3.160e-04"
  const std::size_t e = scientific.find('e');
  const int power = std::stoi(scientific.substr(e + 1));
  const bool is_short = power >= -3 && power < 5;
  std::string text =
      is_short ? fmt::format("{:.{}f}", value, std::max(0, digits - 1 - power)) : scientific.substr(0, e);
  if (text.find('.') != text.npos) text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return is_short ? text : fmt::format("{}e{}", text, power);
}

}  // namespace

std::string fitted_size(std::string_view words, double space) {
  constexpr double kUsualSize = 12;
  const double length = kSvgLetter * double(words.size());
  return length <= space ? "" : fmt::format(" font-size=\"{:.1f}\"", kUsualSize * space / length);
}

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

#include "diagnosis/explanation/headline.h"

#include <algorithm>
#include <array>
#include <utility>

namespace halyard {

std::string unknown_headline(const std::vector<Unexplained>& unexplained) {
  using Kind = Unexplained::Kind;
  static constexpr std::array kClauses = {
      std::pair(Kind::refused, "what explains the training data predicts the hold-out worse"),
      std::pair(Kind::motion, "the motion cannot tell effects apart"),
      std::pair(Kind::unnamed_effect, "an effect acts, but no name for it is sure enough"),
      std::pair(Kind::rest, "a residual that matters is left without an explanation"),
      std::pair(Kind::stuck_sensor, "a sensor stands still while its motor moves"),
      std::pair(Kind::line_above_band, "a signal contains a sine above the frequencies that are compared"),
  };
  std::string text;
  for (const auto& [kind, clause] : kClauses)
    if (std::ranges::count(unexplained, kind, &Unexplained::kind) > 0)
      text += (text.empty() ? "" : "; ") + std::string(clause);
  return text;
}

std::string remainder_headline(const std::vector<Unexplained>& unexplained) {
  using Kind = Unexplained::Kind;
  const auto has = [&](Kind kind) { return std::ranges::count(unexplained, kind, &Unexplained::kind) > 0; };
  if (has(Kind::rest) || has(Kind::refused) || has(Kind::motion)) return "an unexplained residual remains";
  if (has(Kind::unnamed_effect)) return "an effect without a sure name remains";
  if (has(Kind::line_above_band)) return "a sine above the compared frequencies remains";
  return has(Kind::stuck_sensor) ? "a sensor stands still" : "";
}

}  // namespace halyard

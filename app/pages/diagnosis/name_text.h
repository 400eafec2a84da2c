#pragma once
/// Names of effects, their probabilities and sentences, as the terminal and the report tell them.

#include <fmt/core.h>

#include <cctype>
#include <string>

#include "diagnosis/diagnose.h"

namespace halyard {

/// "backlash of joint 2"; an event of one of several logs with that log: "cable_slip of joint 1 in LOG".
inline std::string label_of(const NamedEffect& e) {
  return effect_label(e.effect) + (e.log.empty() ? "" : " in " + e.log);
}

/// "87 %".
inline std::string percent(double probability) { return fmt::format("{:.0f} %", 100 * probability); }

/// The text with a capital first letter. The text must not be empty.
inline std::string capitalised(std::string text) {
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace halyard

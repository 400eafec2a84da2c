#pragma once
/// Names of effects and their probabilities, as the terminal and the report tell them.

#include <fmt/core.h>

#include <string>

#include "diagnosis/diagnose.h"

namespace halyard {

/// "backlash of joint 2"; an event of one of several logs with that log: "cable_slip of joint 1 in LOG".
inline std::string label_of(const NamedEffect& e) {
  return effect_label(e.effect) + (e.log.empty() ? "" : " in " + e.log);
}

/// "87 %".
inline std::string percent(double probability) { return fmt::format("{:.0f} %", 100 * probability); }

}  // namespace halyard

#include <algorithm>

#include "diagnosis/judgement/decision_rule.h"
#include "diagnosis/rehearse.h"

namespace halyard {

bool RehearsedLog::is_right() const {
  if (!failure.empty()) return false;
  if (truth == RehearsedTruth::nothing) return verdict == Diagnosis::Verdict::clean;
  return std::ranges::all_of(hidden, [](const HiddenEffect& h) { return h.is_named || !h.is_visible; }) &&
         std::ranges::all_of(names, &RehearsedName::is_right);
}

RehearsalCount Rehearsal::count(RehearsedTruth truth) const {
  RehearsalCount c;
  for (const RehearsedLog& log : logs) {
    if (log.truth != truth) continue;
    c.logs += 1, c.right += log.is_right(), c.failed += !log.failure.empty();
    for (const HiddenEffect& h : log.hidden)
      (h.is_visible ? c.visible : c.too_small) += 1, c.named += h.is_visible && h.is_named;
    for (const RehearsedName& name : log.names) c.names += 1, c.false_names += !name.is_right;
  }
  return c;
}

double Rehearsal::right_if_certain() const {
  constexpr double kNamesOfTheRule = 20;
  double right = kRule.right_if_certain * kNamesOfTheRule, said = kNamesOfTheRule;
  for (const RehearsedLog& log : logs)
    if (log.truth != RehearsedTruth::found)
      for (const RehearsedName& name : log.names)
        right += name.is_right, said += name.probability / kRule.right_if_certain;
  return std::min(1.0, right / said);
}

double Rehearsal::calibrated(double probability) const {
  return probability / kRule.right_if_certain * right_if_certain();
}

}  // namespace halyard

#include <algorithm>

#include "diagnosis/judgement/decision_rule.h"
#include "diagnosis/rehearse.h"

namespace halyard {

bool Rehearsal::is_right() const {
  if (!failure.empty()) return false;
  if (truth == RehearsedTruth::nothing) return verdict == Diagnosis::Verdict::clean;
  return std::ranges::all_of(hidden, [](const HiddenEffect& h) { return h.is_named || !h.is_visible; }) &&
         std::ranges::all_of(names, &RehearsedName::is_right);
}

RehearsalCount Rehearsals::count(RehearsedTruth truth) const {
  RehearsalCount c;
  for (const Rehearsal& r : all) {
    if (r.truth != truth) continue;
    c.rehearsals += 1, c.right += r.is_right(), c.failed += !r.failure.empty();
    for (const HiddenEffect& h : r.hidden)
      (h.is_visible ? c.visible : c.too_small) += 1, c.named += h.is_visible && h.is_named;
    for (const RehearsedName& name : r.names) c.names += 1, c.false_names += !name.is_right;
  }
  return c;
}

double Rehearsals::right_if_certain() const {
  constexpr double kNamesOfTheRule = 20, kCertain = 0.9;
  double right = kRule.right_if_certain * kNamesOfTheRule, names = kNamesOfTheRule;
  for (const Rehearsal& r : all)
    if (r.truth != RehearsedTruth::found)
      for (const RehearsedName& name : r.names)
        if (name.probability > kCertain * kRule.right_if_certain) right += name.is_right, names += 1;
  return std::min(kRule.right_if_certain, right / names);
}

double Rehearsals::calibrated(double probability) const {
  return probability / kRule.right_if_certain * right_if_certain();
}

}  // namespace halyard

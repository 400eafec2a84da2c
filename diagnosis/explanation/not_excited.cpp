#include "diagnosis/explanation/not_excited.h"

#include "diagnosis/fit/fit_parameter.h"
#include "diagnosis/judgement/judge.h"
#include "diagnosis/prediction/side_by_side.h"
#include "diagnosis/search/attribution.h"

namespace halyard {

std::vector<NotExcited> not_excited(const Evidence& evidence, const Hypothesis& at, const ArmParameters<double>& arm) {
  const auto base = evidence.fit_rows({at})[0];
  const std::vector<PlacedEffect> candidates = all_candidates(arm);
  std::vector<char> shows(candidates.size(), 1);
  run_side_by_side(candidates.size(), [&](std::size_t i) {
    Hypothesis with = at;
    with.effects.push_back(candidates[i]);
    const auto rows = evidence.fit_rows({with})[0];
    shows[i] = rows.empty() || evidence.exceeds_floor(difference(rows, base), 1);
  });
  std::vector<NotExcited> all;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const PlacedEffect& c = candidates[i];
    if (!shows[i])
      all.push_back({c.effect->name(), c.joint,
                     "at its typical size it changes no signal of these data by more than the sensors resolve"});
    else if (!has_enough_periods(evidence, c, arm))
      all.push_back({c.effect->name(), c.joint, "the motion has too few of its periods"});
  }
  return all;
}

}  // namespace halyard

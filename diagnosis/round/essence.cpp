#include "diagnosis/round/essence.h"

#include <algorithm>

namespace halyard {

bool becomes(const PlacedEffect& effect, const PlacedEffect& other, const ArmParameters<double>& arm) {
  const SearchSpace space = search_space(*effect.effect, arm, effect.joint);
  return effect.joint == other.joint && std::ranges::any_of(space.parameters, [&](const ParameterSearch& p) {
           return p.another == other.effect->name();
         });
}

std::optional<WithoutEssence> as_another_effect(const Evidence& evidence, const Refitter& refitter, const Judge& judge,
                                                const Refit& with, std::size_t place) {
  Refit reduced = restarted(with, with.at);
  for (const FitParameter& p : refitter.parameters(with.at))
    if (p.effect == place && p.another_at) set_parameter(reduced.at, p, *p.another_at), reduced.held.push_back(p);
  if (reduced.held.size() == with.held.size()) return {};
  refitter.go_on(reduced, kRule.first_passes);
  if (!reduced.best.usable) return {};
  const Scored all{with.at, evidence.score(with.at)};
  const Scored without{reduced.best.hypothesis, evidence.score(reduced.best.hypothesis)};
  // A name has to explain a share of the residual, an essential parameter need not: friction that stays cannot err in a
  // way that drifts.
  if (judge.gain_over(all, without) > kRule.by_chance &&
      judge.p_of_gain(all.score, without.score) <= kRule.essential_level)
    return {};
  return WithoutEssence{judge.prior_cost(without.hypothesis),
                        log_likelihood(evidence, without.score, squared_floors(evidence))};
}

}  // namespace halyard

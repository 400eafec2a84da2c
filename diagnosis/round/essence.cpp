#include "diagnosis/round/essence.h"

#include <algorithm>

namespace halyard {
namespace {

/// The fit of the other effect in place of the one at `place`, which is at the end of its shapes where both are the
/// same. Nothing if it is there already.
std::optional<Refit> start_of_another(const Refitter& refitter, const Refit& with, std::size_t place,
                                      const AnotherEffect& another) {
  const PlacedEffect& own = with.at.effects[place];
  const ArmParameters<double>& nominal = refitter.nominal();
  PlacedEffect other = place_neutral_effect(*find_effect(another.name), nominal, own.joint);
  if (std::ranges::any_of(with.at.effects, [&](const PlacedEffect& e) { return same_name(e, other); })) return {};
  std::ranges::copy(another.parameters(own.p, with.at.nominal.joint[*own.joint], nominal.joint[*own.joint]), other.p);
  Refit start = restarted(with, refitter.with_effect(without_effect(with.at, place), other));
  start.held = without_parameters_of(with.held, place);
  return start;
}

/// The fit of the effect itself with the essential parameters held; nothing if it has none.
std::optional<Refit> start_without_essence(const Refitter& refitter, const Refit& with, std::size_t place) {
  Refit start = restarted(with, with.at);
  for (const FitParameter& p : refitter.parameters(with.at))
    if (p.effect == place && p.another_at) set_parameter(start.at, p, *p.another_at), start.held.push_back(p);
  if (start.held.size() == with.held.size()) return {};
  return start;
}

}  // namespace

bool becomes(const PlacedEffect& effect, const PlacedEffect& other, const ArmParameters<double>& arm) {
  const std::optional<AnotherEffect> another = search_space(*effect.effect, arm, effect.joint).another;
  return effect.joint == other.joint && another && another->name == other.effect->name();
}

PlacedEffect at_the_end_that_is(const PlacedEffect& other, PlacedEffect effect, const ArmParameters<double>& arm) {
  const std::vector<EffectParameter> parameters = effect.effect->parameters(arm, effect.joint);
  const std::vector<double> end = search_space(*effect.effect, arm, effect.joint).another->parameters_as(other.p);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    effect.p[i] = std::clamp(end[i], parameters[i].lower, parameters[i].upper);
  return effect;
}

bool is_another_effect(const Evidence& evidence, const Refitter& refitter, const Judge& judge, const Refit& with,
                       std::size_t place) {
  const PlacedEffect& effect = with.at.effects[place];
  const std::optional<AnotherEffect> another = search_space(*effect.effect, refitter.nominal(), effect.joint).another;
  std::optional<Refit> reduced =
      another ? start_of_another(refitter, with, place, *another) : start_without_essence(refitter, with, place);
  if (!reduced) return false;
  refitter.go_on(*reduced, kRule.first_passes);
  if (!reduced->best.usable) return false;
  const Scored all{with.at, evidence.score(with.at)};
  const Scored without{reduced->best.hypothesis, evidence.score(reduced->best.hypothesis)};
  // A name has to explain a share of the residual, an essential parameter need not: friction that stays cannot err in a
  // way that drifts.
  return judge.gain_over(all, without) <= kRule.by_chance ||
         judge.p_of_gain(all.score, without.score) > kRule.essential_level;
}

}  // namespace halyard

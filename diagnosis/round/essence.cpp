#include "diagnosis/round/essence.h"

#include <algorithm>

namespace halyard {
namespace {

std::optional<AnotherEffect> another_of(const PlacedEffect& effect, const ArmParameters<double>& arm) {
  return search_space(*effect.effect, arm, effect.joint).another;
}

/// The fit of the other effect in its place.
Refit start_as_the_other(const Refitter& refitter, const Refit& with, std::size_t place) {
  Refit start = restarted(with, with_the_other_effect(refitter, with.at, place));
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
  if (effect.joint != other.joint) return false;
  const std::optional<AnotherEffect> another = another_of(effect, arm);
  return another && another->name == other.effect->name();
}

std::optional<PlacedEffect> at_the_end_that_is(const PlacedEffect& other, PlacedEffect effect,
                                               const ArmParameters<double>& arm) {
  const std::vector<EffectParameter> parameters = effect.effect->parameters(arm, effect.joint);
  const std::vector<double> end = another_of(effect, arm)->own_from_other(other.p);
  bool is_neutral = true;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    effect.p[i] = std::clamp(end[i], parameters[i].lower, parameters[i].upper);
    is_neutral = is_neutral && (parameters[i].is_shape() || effect.p[i] == parameters[i].neutral);
  }
  if (is_neutral) return {};
  return effect;
}

Hypothesis with_the_other_effect(const Refitter& refitter, const Hypothesis& h, std::size_t place) {
  const PlacedEffect& own = h.effects[place];
  const ArmParameters<double>& nominal = refitter.nominal();
  const std::optional<AnotherEffect> another = another_of(own, nominal);
  PlacedEffect other = place_neutral_effect(*find_effect(another->name), nominal, own.joint);
  std::ranges::copy(another->other_from_own(own.p, h.nominal.joint[*own.joint], nominal.joint[*own.joint]), other.p);
  return refitter.with_effect(without_effect(h, place), other);
}

bool is_another_effect(const Evidence& evidence, const Refitter& refitter, const Judge& judge, const Refit& with,
                       std::size_t place) {
  const std::vector<PlacedEffect>& effects = with.at.effects;
  const auto other =
      std::ranges::find_if(effects, [&](const auto& e) { return becomes(effects[place], e, refitter.nominal()); });
  const bool is_there = other != effects.end();
  if (is_there && other - effects.begin() >= static_cast<std::ptrdiff_t>(refitter.given())) return false;
  std::optional<Refit> reduced = !is_there && another_of(effects[place], refitter.nominal())
                                     ? start_as_the_other(refitter, with, place)
                                     : start_without_essence(refitter, with, place);
  if (!reduced) return false;
  refitter.go_on(*reduced, kRule.most_passes);
  if (!reduced->best.usable) return false;
  const Scored all{with.at, evidence.score(with.at)};
  const Scored without{reduced->best.hypothesis, evidence.score(reduced->best.hypothesis)};
  // A name has to explain a share of the residual, an essential parameter need not: friction that stays cannot err in a
  // way that drifts.
  return judge.gain_over(all, without) <= kRule.by_chance ||
         judge.p_of_gain(all.score, without.score) > kRule.essential_level;
}

}  // namespace halyard

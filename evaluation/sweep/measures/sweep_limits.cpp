#include "evaluation/sweep/measures/sweep_limits.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/plan.h"
#include "evaluation/studies/motion_proposal.h"
#include "model/input/cell_text.h"
#include "model/input_error.h"
#include "transmission/effect.h"

namespace halyard {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::quiet_NaN();

/// The parameter that says how large the effect is at this joint; nothing if there is none, or the joint cannot have
/// it.
std::optional<EffectParameter> size_at(const Effect& effect, const ArmModel& model, int joint) {
  if (std::ranges::count(effect_places(effect, model.nominal), EffectPlace(joint)) == 0) return std::nullopt;
  const std::vector<EffectParameter> parameters = effect.parameters(model.nominal, joint);
  const auto size = std::ranges::find_if(parameters, [](const EffectParameter& p) { return !p.is_shape(); });
  return size == parameters.end() ? std::nullopt : std::optional(*size);
}

SweepEffect limited_effect(const std::string& name, const ArmModel& model) {
  const Effect* effect = find_effect(name);
  if (!effect) {
    std::vector<std::string> names;
    for (const Effect* known : effect_library()) names.push_back(known->name());
    throw InputError(
        fmt::format("{} is no effect; expected one or more of {}", in_quotes(name), fmt::join(names, ", ")));
  }
  const auto is_it = [&](const PlacedEffect& placed) { return placed.effect == effect; };
  if (std::ranges::any_of(model.effects, is_it))
    throw InputError(in_quotes(name) + " is in the model already; name an effect that it lacks");
  SweepEffect limited{.name = name, .parameter = "", .units = {}};
  for (int k = 0; k < model.n(); ++k) {
    const std::optional<EffectParameter> size = size_at(*effect, model, k);
    if (size) limited.parameter = size->name;
    limited.units.push_back(size ? size->unit : "");
  }
  if (limited.parameter.empty()) throw InputError(in_quotes(name) + " cannot be at a joint of this arm; leave it out");
  return limited;
}

}  // namespace

std::vector<SweepEffect> parse_limited_effects(std::string_view text, const ArmModel& model) {
  std::vector<std::string_view> names;
  split(text, names);
  std::vector<SweepEffect> effects;
  for (const std::string_view name : names) {
    if (std::ranges::find(effects, name, &SweepEffect::name) != effects.end())
      throw InputError(in_quotes(name) + " is listed twice; list it once");
    effects.push_back(limited_effect(std::string(name), model));
  }
  return effects;
}

std::vector<std::vector<std::vector<double>>> limits_of(const std::vector<SweepEffect>& effects,
                                                        const Scenario& scenario, const ArmModel& model) {
  const Log log = planned_log(planned_scenario(scenario, model), true);
  // A thread that waits for a part of this point must not begin another one, which would need its own memory.
  const std::vector<DetectionLimit> found =
      tbb::this_task_arena::isolate([&] { return detection_limits(model, {log}); });
  std::vector<std::vector<std::vector<double>>> limits;
  for (const SweepEffect& effect : effects) {
    auto& joints = limits.emplace_back(std::size_t(model.n()), std::vector<double>{kNoLimit, kNoLimit});
    for (const DetectionLimit& limit : found) {
      if (limit.effect.effect->name() != effect.name || !limit.effect.joint || !limit.excited) continue;
      joints[std::size_t(*limit.effect.joint)] = {limit.limit, limit.naming_limit.value_or(kNoLimit)};
    }
  }
  return limits;
}

}  // namespace halyard

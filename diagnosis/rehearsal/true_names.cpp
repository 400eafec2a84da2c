#include "diagnosis/rehearsal/true_names.h"

#include <algorithm>

#include "diagnosis/fit/fit_parameter.h"

namespace halyard {

std::vector<std::string> names_of_parts(const std::string& effect) {
  if (effect != "friction_drift") return {};
  return {"motor_friction", "joint_friction"};
}

std::vector<PlacedEffect> effects_beyond_tolerance(const ArmModel& model, const ArmParameters<double>& arm) {
  std::vector<FitParameter> beyond;
  const Hypothesis truth{arm, {}};
  for (const FitParameter& p : baseline_parameters(model)) {
    const double value = parameter_value(truth, p);
    if (value < p.lower || value > p.upper) beyond.push_back(p);
  }
  std::vector<PlacedEffect> effects;
  for (const Effect* effect : effect_library())
    for (const EffectPlace joint : effect_places(*effect, model.nominal)) {
      const PlacedEffect placed = place_effect(*effect, model.nominal, joint);
      if (std::ranges::any_of(beyond, [&](const FitParameter& p) { return effect_changes(placed, model.nominal, p); }))
        effects.push_back(placed);
    }
  return effects;
}

void score_names(const std::vector<NamedEffect>& names, const std::vector<PlacedEffect>& neither, int joints,
                 Rehearsal& rehearsal) {
  for (const NamedEffect& name : names) {
    const auto is_name = [&](const PlacedEffect& e) {
      return e.effect == name.effect.effect && (joints == 1 || e.joint == name.effect.joint);
    };
    const auto truth =
        std::ranges::find_if(rehearsal.hidden, [&](const HiddenEffect& h) { return !h.is_named && is_name(h.effect); });
    const bool is_right = truth != rehearsal.hidden.end();
    if (is_right) truth->is_named = true;
    else if (std::ranges::any_of(neither, is_name)) continue;
    rehearsal.names.push_back({name.effect, name.probability, is_right});
  }
}

}  // namespace halyard

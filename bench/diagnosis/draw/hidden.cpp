#include "bench/diagnosis/draw/hidden.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bench/diagnosis/forms/unregistered.h"
#include "diagnosis/fit/fit.h"
#include "diagnosis/rehearsal/true_names.h"

namespace halyard::blind {
namespace {

/// What trials of this kind may hide in this arm, without places.
std::vector<Hidden> choices(const ArmModel& model, Kind kind) {
  std::vector<Hidden> all;
  if (kind == Kind::form) {
    for (const OtherForm& form : other_forms()) all.push_back({{form.effect}, form.like, form.beside});
  } else if (kind == Kind::outside) {
    for (const Effect* effect : outside_effects()) all.push_back({{effect}, effect->name()});
  } else {
    for (const Effect* effect : effect_library()) all.push_back({{effect}, effect->name()});
  }
  std::erase_if(all, [&](const Hidden& h) { return effect_places(*h.acts.effect, model.nominal).empty(); });
  return all;
}

/// One effect of the library that may stand beside the others; at `joint`, if that is not null.
Hidden draw_beside(const ArmModel& model, const std::vector<Hidden>& others, const EffectPlace* joint, Random& random) {
  std::vector<PlacedEffect> placed;
  for (const Hidden& other : others) placed.push_back(other.acts);
  const std::optional<PlacedEffect> drawn = draw_effect(effect_library(), model, placed, joint, random);
  if (!drawn) throw std::runtime_error("the arm cannot have as many effects");
  return {*drawn, drawn->effect->name()};
}

}  // namespace

Place place_of(const PlacedEffect& effect, int joints) {
  return {effect.effect->name(), joints == 1 ? 1 : effect.joint ? *effect.joint + 1 : 0};
}

std::vector<Hidden> draw_effects(const ArmModel& model, Kind kind, int index, Random& random) {
  std::vector<Hidden> hidden;
  switch (kind) {
    case Kind::clean: break;
    case Kind::effect:
    case Kind::form:
    case Kind::outside: {
      const std::vector<Hidden> all = choices(model, kind);
      hidden.push_back(all[static_cast<std::size_t>(index) % all.size()]);
      hidden[0].acts.joint = random.one_of(effect_places(*hidden[0].acts.effect, model.nominal));
      break;
    }
    case Kind::two_at_joint: {
      const EffectPlace joint = random.below(model.n());
      for (int i = 0; i < 2; ++i) hidden.push_back(draw_beside(model, hidden, &joint, random));
      break;
    }
    case Kind::three:
      for (int i = 0; i < 3; ++i) hidden.push_back(draw_beside(model, hidden, nullptr, random));
      break;
  }
  // A delay acts on what comes before it.
  std::ranges::stable_partition(hidden, [](const Hidden& h) { return h.right_name == "delay"; });
  return hidden;
}

std::vector<std::string> names_beside(const Hidden& hidden) {
  std::vector<std::string> names = names_of_parts(hidden.right_name);
  if (!hidden.right_beside.empty()) names.insert(names.begin(), hidden.right_beside);
  return names;
}

double relative_size(const PlacedEffect& effect, const ArmModel& model) {
  const std::vector<SearchedParameter> all = searched_parameters(effect, model);
  double most = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].is_size())
      most = std::max(most, std::abs((effect.p[i] - all[i].p.neutral) / (all[i].p.typical - all[i].p.neutral)));
  return most;
}

std::vector<TrueParameter> true_parameters(const PlacedEffect& effect, const ArmModel& model) {
  const std::vector<SearchedParameter> all = searched_parameters(effect, model);
  bool every_size = true;
  for (std::size_t i = 0; i < all.size(); ++i)
    every_size = every_size && (!all[i].is_size() || effect.p[i] != all[i].p.neutral);
  std::vector<TrueParameter> told;
  for (std::size_t i = 0; i < all.size(); ++i)
    told.push_back({all[i].p.name, effect.p[i], all[i].is_size() || every_size});
  return told;
}

void mistune(ArmModel& robot, int off, const std::vector<Hidden>& hidden, Random& random) {
  const ArmParameters<double> model = robot.nominal;
  Hypothesis h{robot.nominal, {}};
  for (const FitParameter& p : baseline_parameters(robot)) {
    const double by = off * random.uniform(-1, 1) * (p.upper - p.nominal);
    const bool is_effects =
        std::ranges::any_of(hidden, [&](const Hidden& e) { return effect_covers(e.acts, model, p); });
    if (!is_effects) set_parameter(h, p, p.nominal + by);
  }
  robot.nominal = h.nominal;
}

std::vector<Place> names_beyond_tolerance(const ArmModel& model, const ArmModel& robot) {
  std::vector<Place> names;
  for (const PlacedEffect& effect : effects_beyond_tolerance(model, robot.nominal))
    names.push_back(place_of(effect, model.n()));
  return names;
}

}  // namespace halyard::blind

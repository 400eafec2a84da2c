#include "transmission/effect.h"

#include <algorithm>
#include <stdexcept>

#include "transmission/effects/library.h"

namespace halyard {
namespace {

struct Library {
  std::vector<std::unique_ptr<const Effect>> owned = built_in_effects();
  std::vector<const Effect*> all;
  Library() {
    for (const auto& e : owned) all.push_back(e.get());
  }
};

Library& library() {
  static Library instance;
  return instance;
}

}  // namespace

std::string effect_label(const PlacedEffect& effect) {
  return effect.effect->name() + (effect.joint ? " of joint " + std::to_string(*effect.joint + 1) : "");
}

const std::vector<const Effect*>& effect_library() { return library().all; }

const Effect* find_effect(const std::string& name) {
  for (const Effect* e : effect_library())
    if (e->name() == name) return e;
  return nullptr;
}

void register_effect(std::unique_ptr<const Effect> effect) {
  if (find_effect(effect->name()))
    throw std::invalid_argument("effect \"" + effect->name() + "\" is already in the library: give yours another name");
  if (effect->n_states() > kMaxEffectStates)
    throw std::invalid_argument("effect \"" + effect->name() + "\" has " + std::to_string(effect->n_states()) +
                                " states: expected at most " + std::to_string(kMaxEffectStates));
  library().all.push_back(effect.get());
  library().owned.push_back(std::move(effect));
}

std::vector<EffectPlace> effect_places(const Effect& effect, const ArmParameters<double>& arm) {
  std::vector<EffectPlace> places;
  if (effect.scope() != EffectScope::joint) places.push_back(kWholeArm);
  for (int joint = 0; joint < arm.n && effect.scope() != EffectScope::arm; ++joint)
    if (effect.applies(arm, joint)) places.push_back(joint);
  return places;
}

namespace {

PlacedEffect place_with(double EffectParameter::*value, const Effect& effect, const ArmParameters<double>& arm,
                        EffectPlace joint) {
  const std::vector<EffectPlace> places = effect_places(effect, arm);
  if (std::find(places.begin(), places.end(), joint) == places.end())
    throw std::invalid_argument("effect " + effect.name() +
                                (effect.scope() == EffectScope::arm ? " belongs to the whole arm: name no joint"
                                 : joint == kWholeArm
                                     ? " belongs to a joint: name one"
                                     : " cannot be at joint " + std::to_string(*joint + 1) + " of this arm"));
  PlacedEffect placed;
  placed.effect = &effect;
  placed.joint = joint;
  const auto parameters = effect.parameters(arm, joint);
  if (parameters.size() > static_cast<std::size_t>(kMaxEffectParameters))
    throw std::invalid_argument("effect " + effect.name() + " has " + std::to_string(parameters.size()) +
                                " parameters: expected at most " + std::to_string(kMaxEffectParameters));
  for (std::size_t i = 0; i < parameters.size(); ++i) placed.p[i] = parameters[i].*value;
  return placed;
}

}  // namespace

PlacedEffect place_effect(const Effect& effect, const ArmParameters<double>& arm, EffectPlace joint) {
  return place_with(&EffectParameter::typical, effect, arm, joint);
}

PlacedEffect place_neutral_effect(const Effect& effect, const ArmParameters<double>& arm, EffectPlace joint) {
  return place_with(&EffectParameter::neutral, effect, arm, joint);
}

void keep_within_bounds(PlacedEffect& effect, const ArmParameters<double>& arm) {
  const std::vector<EffectParameter> parameters = effect.effect->parameters(arm, effect.joint);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    effect.p[i] = std::clamp(effect.p[i], parameters[i].lower, parameters[i].upper);
}

}  // namespace halyard

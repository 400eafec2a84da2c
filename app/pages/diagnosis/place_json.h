#pragma once
/// Where an effect is, as the JSON of diagnoses and plans tells it.

#include <nlohmann/json.hpp>

#include "transmission/effect.h"

namespace halyard {

/// The joint's number; null: the whole arm.
inline nlohmann::ordered_json joint_json(EffectPlace joint) {
  return joint ? nlohmann::ordered_json(*joint + 1) : nlohmann::ordered_json(nullptr);
}

/// {"effect": name, "joint": number}
inline nlohmann::ordered_json place_json(const PlacedEffect& e) {
  return {{"effect", e.effect->name()}, {"joint", joint_json(e.joint)}};
}

}  // namespace halyard

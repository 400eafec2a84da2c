#include "evaluation/sweep/sweep_parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include "model/input_error.h"
#include "model/name_list.h"
#include "transmission/arm_fields.h"

namespace halyard {
namespace {

struct EffectKey {
  EffectPlace joint;  ///< 0-based; a number that the user gave, not checked
  std::string effect, parameter;
};

/// "joint2.effect.backlash.half_gap" taken apart; nothing if the key has not this form.
std::optional<EffectKey> parse_effect_key(std::string_view key) {
  const auto next_part = [&key] {
    const std::string_view part = key.substr(0, key.find('.'));
    key.remove_prefix(std::min(key.size(), part.size() + 1));
    return part;
  };
  const std::string_view place = next_part();
  if (next_part() != "effect") return std::nullopt;
  EffectKey parsed{kWholeArm, std::string(next_part()), std::string(key)};
  if (place == "arm") return parsed;
  if (!place.starts_with("joint")) return std::nullopt;
  const char* end = place.data() + place.size();
  int number = 0;
  const auto [rest, error] = std::from_chars(place.data() + 5, end, number);
  if (error != std::errc() || rest != end) return std::nullopt;
  // Each joint has one spelling: an axis of joint2 and one of joint02 would vary the same number.
  const bool is_plain = place[5] >= '1' && place[5] <= '9';
  parsed.joint = is_plain ? number - 1 : -1;
  return parsed;
}

/// The model's effect, or a new one. Placed for one of its sizes it has no other; for a shape it has typical sizes.
PlacedEffect& placed_effect(ArmModel& model, const Effect& effect, EffectPlace joint, const std::string& parameter) {
  for (PlacedEffect& placed : model.effects) {
    if (placed.effect == &effect && placed.joint == joint) return placed;
  }
  PlacedEffect placed = place_effect(effect, model.nominal, joint);
  for (const EffectParameter& p : effect.parameters(model.nominal, joint))
    if (p.name == parameter && !p.is_shape()) placed = place_neutral_effect(effect, model.nominal, joint);
  model.effects.push_back(placed);
  return model.effects.back();
}

/// Number and unit of an effect's parameter.
std::pair<ArmNumber, std::string> effect_parameter(ArmModel& model, const EffectKey& key, const std::string& text) {
  const auto fail = [&](const std::string& what) { throw InputError("parameter " + in_quotes(text) + ": " + what); };
  const Effect* effect = find_effect(key.effect);
  if (!effect) {
    std::vector<std::string> names;
    for (const Effect* known : effect_library()) names.push_back(known->name());
    fail(fmt::format("unknown effect; expected one of {}, or one of a module given by --effects", listed(names)));
  }
  const EffectScope scope = effect->scope();
  const bool fits =
      key.joint ? scope != EffectScope::arm && *key.joint >= 0 && *key.joint < model.n() : scope != EffectScope::joint;
  if (!fits) {
    fail(scope == EffectScope::arm
             ? fmt::format("the effect is of the whole arm; write arm.effect.{}.{}", key.effect, key.parameter)
             : fmt::format("the effect is of a joint; write jointK.effect.{}.{} with K from 1 to {}", key.effect,
                           key.parameter, model.n()));
  }
  PlacedEffect* placed = nullptr;
  try {
    placed = &placed_effect(model, *effect, key.joint, key.parameter);
  } catch (const std::invalid_argument& error) {
    fail(std::string(error.what()) + "; name another joint");
  }
  const std::vector<EffectParameter> parameters = effect->parameters(model.nominal, key.joint);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].name == key.parameter) return {ArmNumber(placed->p[i]), parameters[i].unit};
    names.push_back(parameters[i].name);
  }
  throw InputError(
      fmt::format("parameter {}: the effect has no such number; expected one of {}", in_quotes(text), listed(names)));
}

struct Number {
  std::string key, unit;
  ArmNumber number;
};

/// Numbers of a joint that named_parameters() leaves out: the encoders'.
void add_unnamed_fields(JointParameters<double>& joint, const std::string& prefix, std::vector<Number>& all) {
  bool zero_known = true;  // of the offset that follows
  const auto visit = [&](const ArmField& field, auto& value) {
    using Value = std::remove_reference_t<decltype(value)>;
    if (!field.noun.empty() || !field.exists_at(joint.drive)) return;
    if constexpr (std::is_same_v<Value, bool>) zero_known = value;
    if constexpr (std::is_same_v<Value, double>) {
      const bool is_unknown_offset = field.name.ends_with("_offset") && !zero_known;
      if (!is_unknown_offset)
        all.push_back({prefix + std::string(field.part) + "." + std::string(field.name), field.unit.of(joint.type),
                       ArmNumber(value)});
    }
  };
  for_each_joint_field(visit, joint);
}

/// All of the model but those of effects.
std::vector<Number> numbers_of(ArmModel& model) {
  std::vector<Number> all;
  for (const ParameterInfo& info : named_parameters(model.nominal)) all.push_back({info.key, info.unit, info.number});
  for (int k = 0; k < model.n(); ++k) {
    const std::string prefix = fmt::format("joint{}.", k + 1);
    JointParameters<double>& joint = model.nominal.joint[k];
    add_unnamed_fields(joint, prefix, all);
    if (joint.drive == Drive::none) continue;
    ControllerParameters& controller = model.joints[k].controller;
    all.push_back({prefix + "controller.kp", "N m/rad", ArmNumber(controller.kp)});
    all.push_back({prefix + "controller.kd", "N m s/rad", ArmNumber(controller.kd)});
    all.push_back({prefix + "controller.torque_limit", "N m", ArmNumber(controller.torque_limit)});
  }
  return all;
}

std::pair<ArmNumber, std::string> find_parameter(ArmModel& model, const std::string& key) {
  if (const auto effect_key = parse_effect_key(key)) return effect_parameter(model, *effect_key, key);
  const std::vector<Number> all = numbers_of(model);
  const std::string joint = key.substr(0, key.find('.') + 1);  // of a right joint, its numbers will do
  const auto is_of_joint = [&](const Number& number) { return !joint.empty() && number.key.starts_with(joint); };
  const bool is_right = std::ranges::any_of(all, is_of_joint);
  std::vector<std::string> keys;
  for (const Number& number : all) {
    if (number.key == key) return {number.number, number.unit};
    if (!is_right || is_of_joint(number)) keys.push_back(number.key);
  }
  throw InputError(
      fmt::format("parameter {}: the model has none of that name; expected one of {}, jointK.effect.NAME.PARAMETER or "
                  "arm.effect.NAME.PARAMETER",
                  in_quotes(key), listed(keys)));
}

}  // namespace

ArmNumber model_parameter(ArmModel& model, const std::string& key) { return find_parameter(model, key).first; }

std::string parameter_unit(ArmModel model, const std::string& key) {
  std::string unit = find_parameter(model, key).second;
  if (unit == "1") unit.clear();
  return unit;
}

}  // namespace halyard

#include "diagnosis/search_space.h"

#include <algorithm>
#include <functional>

#include "diagnosis/search_space/built_in.h"
#include "model/input_error.h"

namespace halyard {
namespace {

const BuiltInSpace* find_built_in(const std::string& effect) {
  for (const auto spaces : {cable_spaces(), joint_spaces(), motor_spaces(), sensor_spaces()})
    for (const BuiltInSpace& space : spaces)
      if (space.effect == effect) return &space;
  return nullptr;
}

/// Bounds and neutral values alone: the fit sets out from what the effect typically is.
SearchSpace derived_space(const std::vector<EffectParameter>& parameters) {
  SearchSpace space;
  for (const EffectParameter& p : parameters) space.parameters.push_back({.name = p.name});
  return space;
}

[[noreturn]] void refuse(const Effect& effect, const std::string& why) {
  throw InputError("effect " + in_quotes(effect.name()) + ": " + why);
}

/// What a user's refinement can get wrong.
void check(const SearchSpace& space, const std::vector<EffectParameter>& parameters, const Effect& effect,
           const ArmParameters<double>& arm) {
  if (!std::ranges::equal(space.parameters, parameters, {}, &ParameterSearch::name, &EffectParameter::name))
    refuse(effect, "its search space has other parameters than itself; change those that it is given");
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const EffectParameter& p = parameters[i];
    const std::vector<double>& starts = space.parameters[i].starts;
    if (std::ranges::adjacent_find(starts, std::greater_equal{}) != starts.end())
      refuse(effect, "the starts of " + in_quotes(p.name) + " do not ascend; give each once, the smallest first");
    if (!starts.empty() && !(starts.front() >= p.lower && starts.back() <= p.upper))
      refuse(effect, "starts of " + in_quotes(p.name) + " lie outside its bounds; move them inside");
    const TolerancedNumber& number = space.parameters[i].changes;
    if (number.kind && (number.joint < 0 || number.joint >= arm.n || !(number.size >= 0)))
      refuse(effect, "the number that " + in_quotes(p.name) +
                         " changes is negative or of no joint; give a joint of the arm, and a size of 0 or more");
  }
  if (space.another) refuse(effect, "it gives another effect; only the library's own effects do; leave it out");
  for (const auto& order : {space.order_of_motor_torque, space.order_of_joint_position})
    if (order && *order >= parameters.size())
      refuse(effect, "the index of its order is no parameter of it; give the index of one");
  if (space.greatest_motor_speed && *space.greatest_motor_speed >= parameters.size())
    refuse(effect, "the index of its greatest motor speed is no parameter of it; give the index of one");
}

}  // namespace

SearchSpace search_space(const Effect& effect, const ArmParameters<double>& arm, EffectPlace joint) {
  const std::vector<EffectParameter> parameters = effect.parameters(arm, joint);
  SearchSpace space = derived_space(parameters);
  if (const auto* own = dynamic_cast<const RefinesSearch*>(&effect)) {
    try {
      own->refine_search(space, arm, joint);
    } catch (const std::exception& error) {
      refuse(effect, std::string("its search space cannot be told: ") + error.what());
    }
    check(space, parameters, effect, arm);
  } else if (const BuiltInSpace* built_in = find_built_in(effect.name())) {
    built_in->refine(space, arm, joint.value_or(0));
  }
  return space;
}

std::vector<std::size_t> instants_of(const PlacedEffect& effect, const ArmParameters<double>& arm) {
  const SearchSpace space = search_space(*effect.effect, arm, effect.joint);
  std::vector<std::size_t> instants;
  for (std::size_t i = 0; i < space.parameters.size(); ++i)
    if (space.parameters[i].range == SearchRange::record_time) instants.push_back(i);
  return instants;
}

bool has_instants(const PlacedEffect& effect, const ArmParameters<double>& arm) {
  return !instants_of(effect, arm).empty();
}

bool is_event(const PlacedEffect& effect, const ArmParameters<double>& arm) {
  const std::vector<std::size_t> instants = instants_of(effect, arm);
  const std::vector<EffectParameter> parameters = effect.effect->parameters(arm, effect.joint);
  bool acts = false;  // a size of the shapes that follow is not neutral
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const bool is_shape = parameters[i].is_shape();
    if (is_shape && acts && std::ranges::find(instants, i) != instants.end()) return true;
    if (is_shape) continue;
    const bool begins = i == 0 || parameters[i - 1].is_shape();
    acts = (acts && !begins) || effect.p[i] != parameters[i].neutral;
  }
  return false;
}

}  // namespace halyard

#include "bench/diagnosis/draw/hidden.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bench/diagnosis/forms/unregistered.h"
#include "diagnosis/fit/fit.h"

namespace halyard::blind {
namespace {

constexpr double kShortOfBound = 0.95;
constexpr double kLeastFactor = 0.5, kMostFactor = 3;  // of the typical size

/// A parameter with how the diagnosis looks for it.
struct Drawn {
  EffectParameter p;
  ParameterSearch search;
  bool is_size() const { return search.range == SearchRange::own && !p.is_shape(); }
};

std::vector<Drawn> drawn_parameters(const PlacedEffect& effect, const ArmModel& model) {
  const std::vector<EffectParameter> parameters = effect.effect->parameters(model.nominal, effect.joint);
  const SearchSpace space = search_space(*effect.effect, model.nominal, effect.joint);
  std::vector<Drawn> all;
  for (std::size_t i = 0; i < parameters.size(); ++i) all.push_back({parameters[i], space.parameters[i]});
  return all;
}

/// A limit of nature may be reached; the end of what is plausible not quite.
double within_bounds(const Drawn& drawn, double value) {
  const EffectParameter& p = drawn.p;
  const double way = drawn.search.natural_bounds ? 1 : kShortOfBound;
  return std::clamp(value, p.neutral + way * (p.lower - p.neutral), p.neutral + way * (p.upper - p.neutral));
}

double draw_size(const Drawn& drawn, Random& random) {
  const EffectParameter& p = drawn.p;
  const double change = (p.typical - p.neutral) * random.log_uniform(kLeastFactor, kMostFactor);
  const bool both = p.neutral - change >= p.lower && p.neutral - change <= p.upper;
  return within_bounds(drawn, p.neutral + (both && random.chance(0.5) ? -change : change));
}

/// Radians of the motor per rad or metre of its own joint; 1 for a joint without a motor.
double motor_per_joint(const JointParameters<double>& joint) {
  return joint.drive == Drive::none ? 1 : joint.pulley_radius / std::abs(joint.motor_travel());
}

/// Limits shapes to what the motion of joint k can show of this effect.
void limit_to_motion(std::vector<Drawn>& all, const PlacedEffect& effect, const ArmModel& model, const Ranges& ranges) {
  const std::size_t k = effect.joint.value_or(0);
  const double motor = motor_per_joint(model.nominal.joint[k]);
  const SearchSpace space = search_space(*effect.effect, model.nominal, effect.joint);
  const double reach = (ranges.joint[k].to - ranges.joint[k].from) / (2 * std::numbers::pi);
  for (std::size_t i = 0; i < all.size(); ++i) {
    Drawn& d = all[i];
    const double fastest = d.search.per_motor_speed * motor * ranges.fastest[k];
    if (fastest > 0) d.p.upper = std::min(d.p.upper, kNearStandstill * fastest);
    const bool of_motor = space.order_of_motor_torque == i;
    if (!of_motor && space.order_of_joint_position != i) continue;
    const auto has_too_few = [&](double order) { return order * reach * (of_motor ? motor : 1) < kFewestPeriods; };
    if (!has_too_few(d.search.starts.back())) std::erase_if(d.search.starts, has_too_few);
  }
}

/// Orders are whole numbers; anything else lies beside where a search sets out.
double draw_shape(const Drawn& drawn, Random& random) {
  const EffectParameter& p = drawn.p;
  const std::vector<double>& starts = drawn.search.starts;
  const double start = starts.empty() ? p.typical : random.one_of(starts);
  if (p.unit == "1" && start == std::round(start)) return start;
  constexpr double kMost = 2;
  return std::max(p.lower, std::min(start, p.upper / kMost) * random.log_uniform(1 / kMost, kMost));
}

/// True for a size without which the effect is another one: friction that does not change in time is motor_friction.
bool is_essential(const PlacedEffect& effect, const Drawn& size) {
  return effect.effect->name() == "friction_drift" && size.p.name == "rate";
}

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
  std::vector<Hidden> all;
  for (const Hidden& choice : choices(model, Kind::effect)) {
    Hidden hidden = choice;
    std::vector<EffectPlace> places = effect_places(*choice.acts.effect, model.nominal);
    std::erase_if(places, [&](EffectPlace place) {
      return (joint && place != *joint) || std::ranges::any_of(others, [&](const Hidden& other) {
               return other.acts.effect == choice.acts.effect && other.acts.joint == place;
             });
    });
    if (places.empty()) continue;
    hidden.acts.joint = random.one_of(places);
    all.push_back(hidden);
  }
  if (all.empty()) throw std::runtime_error("the arm cannot have as many effects");
  return random.one_of(all);
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

void draw_parameters(PlacedEffect& effect, const ArmModel& model, const Ranges& ranges, Random& random) {
  std::vector<Drawn> all = drawn_parameters(effect, model);
  limit_to_motion(all, effect, model, ranges);
  const double length = ranges.record.to - ranges.record.from;
  std::vector<std::size_t> sizes, instants;
  for (std::size_t i = 0; i < all.size(); ++i) {
    switch (all[i].search.range) {
      case SearchRange::record_time: instants.push_back(i); break;
      case SearchRange::joint_position: {
        const Range& reach = ranges.joint[effect.joint.value_or(0)];
        effect.p[i] = reach.from + random.uniform(0.2, 0.8) * (reach.to - reach.from);
        break;
      }
      case SearchRange::own:
        if (all[i].is_size()) sizes.push_back(i);
        effect.p[i] = all[i].is_size() ? all[i].p.neutral : draw_shape(all[i], random);
        break;
    }
  }
  // From one instant to the next of the same effect at least a tenth of the record.
  std::vector<double> times;
  for (std::size_t i = 0; i < instants.size(); ++i)
    times.push_back(random.uniform(0.1, 0.7 - 0.1 * static_cast<double>(instants.size())));
  std::ranges::sort(times);
  for (std::size_t i = 0; i < instants.size(); ++i)
    effect.p[instants[i]] = ranges.record.from + (times[i] + 0.1 * static_cast<double>(i)) * length;
  const int for_certain = random.below(static_cast<int>(sizes.size()));
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    const bool present =
        random.chance(0.5) || static_cast<int>(s) == for_certain || is_essential(effect, all[sizes[s]]);
    if (present) effect.p[sizes[s]] = draw_size(all[sizes[s]], random);
  }
}

std::vector<std::string> names_beside(const Hidden& hidden) {
  std::vector<std::string> names;
  if (!hidden.right_beside.empty()) names.push_back(hidden.right_beside);
  if (hidden.right_name == "friction_drift") names.insert(names.end(), {"motor_friction", "joint_friction"});
  return names;
}

double relative_size(const PlacedEffect& effect, const ArmModel& model) {
  const std::vector<Drawn> all = drawn_parameters(effect, model);
  double most = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].is_size())
      most = std::max(most, std::abs((effect.p[i] - all[i].p.neutral) / (all[i].p.typical - all[i].p.neutral)));
  return most;
}

std::vector<TrueParameter> true_parameters(const PlacedEffect& effect, const ArmModel& model) {
  const std::vector<Drawn> all = drawn_parameters(effect, model);
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
  std::vector<FitParameter> beyond;
  const Hypothesis truth{robot.nominal, {}};
  for (const FitParameter& p : baseline_parameters(model)) {
    const double value = parameter_value(truth, p);
    if (value < p.lower || value > p.upper) beyond.push_back(p);
  }
  std::vector<Place> names;
  for (const Effect* effect : effect_library())
    for (const EffectPlace joint : effect_places(*effect, model.nominal)) {
      const PlacedEffect placed = place_effect(*effect, model.nominal, joint);
      if (std::ranges::any_of(beyond, [&](const FitParameter& p) { return effect_changes(placed, model.nominal, p); }))
        names.push_back(place_of(placed, model.n()));
    }
  return names;
}

}  // namespace halyard::blind

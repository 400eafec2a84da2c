#include "diagnosis/rehearsal/drawn_effect.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace halyard {
namespace {

constexpr double kShortOfBound = 0.95;
constexpr double kLeastFactor = 0.5, kMostFactor = 3;  // of the typical size

/// A limit of nature may be reached; the end of what is plausible not quite.
double within_bounds(const SearchedParameter& drawn, double value) {
  const EffectParameter& p = drawn.p;
  const double way = drawn.search.natural_bounds ? 1 : kShortOfBound;
  return std::clamp(value, p.neutral + way * (p.lower - p.neutral), p.neutral + way * (p.upper - p.neutral));
}

double draw_size(const SearchedParameter& drawn, Random& random) {
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
void limit_to_motion(std::vector<SearchedParameter>& all, const PlacedEffect& effect, const ArmModel& model,
                     const MotionRange& motion) {
  const std::size_t k = effect.joint.value_or(0);
  const double motor = motor_per_joint(model.nominal.joint[k]);
  const SearchSpace space = search_space(*effect.effect, model.nominal, effect.joint);
  const double reach = (motion.joint[k].to - motion.joint[k].from) / (2 * std::numbers::pi);
  for (std::size_t i = 0; i < all.size(); ++i) {
    SearchedParameter& d = all[i];
    const double fastest = d.search.per_motor_speed * motor * motion.fastest[k];
    if (fastest > 0) d.p.upper = std::min(d.p.upper, kNearStandstill * fastest);
    const bool of_motor = space.order_of_motor_torque == i;
    if (!of_motor && space.order_of_joint_position != i) continue;
    const auto has_too_few = [&](double order) { return order * reach * (of_motor ? motor : 1) < kFewestPeriods; };
    if (!has_too_few(d.search.starts.back())) std::erase_if(d.search.starts, has_too_few);
  }
}

/// Orders are whole numbers; anything else lies beside where a search sets out.
double draw_shape(const SearchedParameter& drawn, Random& random) {
  const EffectParameter& p = drawn.p;
  const std::vector<double>& starts = drawn.search.starts;
  const double start = starts.empty() ? p.typical : random.one_of(starts);
  if (p.unit == "1" && start == std::round(start)) return start;
  constexpr double kMost = 2;
  return std::max(p.lower, std::min(start, p.upper / kMost) * random.log_uniform(1 / kMost, kMost));
}

/// True for a size without which the effect is another one: friction that does not change in time is motor_friction.
bool is_essential(const PlacedEffect& effect, const SearchedParameter& size) {
  return effect.effect->name() == "friction_drift" && size.p.name == "rate";
}

}  // namespace

std::vector<SearchedParameter> searched_parameters(const PlacedEffect& effect, const ArmModel& model) {
  const std::vector<EffectParameter> parameters = effect.effect->parameters(model.nominal, effect.joint);
  const SearchSpace space = search_space(*effect.effect, model.nominal, effect.joint);
  std::vector<SearchedParameter> all;
  for (std::size_t i = 0; i < parameters.size(); ++i) all.push_back({parameters[i], space.parameters[i]});
  return all;
}

std::optional<PlacedEffect> draw_effect(const std::vector<const Effect*>& from, const ArmModel& model,
                                        const std::vector<PlacedEffect>& others, const EffectPlace* joint,
                                        Random& random) {
  std::vector<PlacedEffect> all;
  for (const Effect* effect : from) {
    std::vector<EffectPlace> places = effect_places(*effect, model.nominal);
    std::erase_if(places, [&](EffectPlace place) {
      return (joint && place != *joint) || std::ranges::any_of(others, [&](const PlacedEffect& other) {
               return other.effect == effect && other.joint == place;
             });
    });
    if (!places.empty()) all.push_back({effect, random.one_of(places)});
  }
  if (all.empty()) return {};
  return random.one_of(all);
}

void draw_parameters(PlacedEffect& effect, const ArmModel& model, const MotionRange& motion, Random& random) {
  std::vector<SearchedParameter> all = searched_parameters(effect, model);
  limit_to_motion(all, effect, model, motion);
  const double length = motion.record.to - motion.record.from;
  std::vector<std::size_t> sizes, instants;
  for (std::size_t i = 0; i < all.size(); ++i) {
    switch (all[i].search.range) {
      case SearchRange::record_time: instants.push_back(i); break;
      case SearchRange::joint_position: {
        const MotionRange::Range& reach = motion.joint[effect.joint.value_or(0)];
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
    effect.p[instants[i]] = motion.record.from + (times[i] + 0.1 * static_cast<double>(i)) * length;
  const int for_certain = random.below(static_cast<int>(sizes.size()));
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    const bool present =
        random.chance(0.5) || static_cast<int>(s) == for_certain || is_essential(effect, all[sizes[s]]);
    if (present) effect.p[sizes[s]] = draw_size(all[sizes[s]], random);
  }
}

}  // namespace halyard

#include "bench/diagnosis/draw.h"

#include <algorithm>
#include <cmath>

#include "bench/diagnosis/unregistered.h"
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

/// Orders are whole numbers; anything else lies beside where a search sets out.
double draw_shape(const Drawn& drawn, Random& random) {
  const EffectParameter& p = drawn.p;
  const std::vector<double>& starts = drawn.search.starts;
  const double start = starts.empty() ? p.typical : random.one_of(starts);
  const bool is_order = p.unit == "1" && start == std::round(start);
  return std::clamp(is_order ? start : start * random.log_uniform(0.5, 2), p.lower, p.upper);
}

}  // namespace

Hidden draw_effect(const ArmModel& model, Kind kind, int index, const std::vector<Hidden>& beside, Random& random) {
  std::vector<Hidden> all;
  if (kind == Kind::form) {
    for (const OtherForm& form : other_forms()) all.push_back({{form.effect}, form.like});
  } else if (kind == Kind::outside) {
    for (const Effect* effect : outside_effects()) all.push_back({{effect}, effect->name()});
  } else {
    for (const Effect* effect : effect_library()) all.push_back({{effect}, effect->name()});
  }
  std::erase_if(all, [&](const Hidden& h) { return effect_places(*h.acts.effect, model.nominal).empty(); });
  for (;;) {
    Hidden hidden = kind == Kind::each_effect ? all[index % all.size()] : random.one_of(all);
    hidden.acts.joint = random.one_of(effect_places(*hidden.acts.effect, model.nominal));
    const bool free = std::ranges::none_of(beside, [&](const Hidden& other) {
      return other.acts.effect == hidden.acts.effect || other.acts.joint == hidden.acts.joint;
    });
    if (free) return hidden;
  }
}

void draw_parameters(PlacedEffect& effect, const ArmModel& model, const Ranges& ranges, Random& random) {
  const std::vector<Drawn> all = drawn_parameters(effect, model);
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
    const bool present = random.chance(0.5) || static_cast<int>(s) == for_certain;
    if (present) effect.p[sizes[s]] = draw_size(all[sizes[s]], random);
  }
}

bool enlarge(PlacedEffect& effect, const ArmModel& model, double factor) {
  const std::vector<Drawn> all = drawn_parameters(effect, model);
  bool moved = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].is_size()) continue;
    const double larger = within_bounds(all[i], all[i].p.neutral + factor * (effect.p[i] - all[i].p.neutral));
    moved = moved || larger != effect.p[i];
    effect.p[i] = larger;
  }
  return moved;
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

bool happens_at_an_instant(const PlacedEffect& effect, const ArmModel& model) {
  return std::ranges::any_of(search_space(*effect.effect, model.nominal, effect.joint).parameters,
                             [](const ParameterSearch& p) { return p.range == SearchRange::record_time; });
}

void mistune(ArmModel& robot, Random& random) {
  Hypothesis h{robot.nominal, {}};
  for (const FitParameter& p : baseline_parameters(robot)) set_parameter(h, p, random.uniform(p.lower, p.upper));
  robot.nominal = h.nominal;
  for (int k = 0; k < robot.n(); ++k) {
    JointParameters<double>& j = robot.nominal.joint[k];
    const Tolerances& tolerances = robot.joints[k].tolerances;
    for (double& x : j.com) x *= 1 + tolerances.length * random.uniform(-1, 1);
    // One factor for all moments: six of their own need not belong to any body.
    const double factor = 1 + tolerances.mass * random.uniform(-1, 1);
    for (double& moment : j.inertia) moment *= factor;
  }
}

}  // namespace halyard::blind

#include "bench/diagnosis/draw.h"

#include <algorithm>
#include <cmath>

#include "bench/diagnosis/unregistered.h"
#include "diagnosis/fit.h"

namespace halyard::blind {
namespace {

constexpr double kShortOfBound = 0.95;
constexpr double kLeastFactor = 0.5, kMostFactor = 3;  // of the typical size

bool is_size(const EffectParameter& p) { return p.range == SearchRange::own && !p.is_shape(); }

/// A limit of nature may be reached; the end of what is plausible not quite.
double within_bounds(const EffectParameter& p, double value) {
  const double way = p.natural_bounds ? 1 : kShortOfBound;
  return std::clamp(value, p.neutral + way * (p.lower - p.neutral), p.neutral + way * (p.upper - p.neutral));
}

double draw_size(const EffectParameter& p, Random& random) {
  const double change = (p.typical - p.neutral) * random.log_uniform(kLeastFactor, kMostFactor);
  const bool both = p.neutral - change >= p.lower && p.neutral - change <= p.upper;
  return within_bounds(p, p.neutral + (both && random.chance(0.5) ? -change : change));
}

/// Orders are whole numbers; anything else lies beside where a search sets out.
double draw_shape(const EffectParameter& p, Random& random) {
  const double start = p.starts.empty() ? p.typical : random.one_of(p.starts);
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
  const std::vector<EffectParameter> all = effect.effect->parameters(model.nominal, effect.joint);
  const double length = ranges.record.to - ranges.record.from;
  std::vector<std::size_t> sizes, instants;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const EffectParameter& p = all[i];
    switch (p.range) {
      case SearchRange::record_time: instants.push_back(i); break;
      case SearchRange::joint_position: {
        const Range& reach = ranges.joint[std::max(0, effect.joint)];
        effect.p[i] = reach.from + random.uniform(0.2, 0.8) * (reach.to - reach.from);
        break;
      }
      case SearchRange::own:
        if (is_size(p)) sizes.push_back(i);
        effect.p[i] = is_size(p) ? p.neutral : draw_shape(p, random);
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
  const std::vector<EffectParameter> all = effect.effect->parameters(model.nominal, effect.joint);
  bool moved = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!is_size(all[i])) continue;
    const double larger = within_bounds(all[i], all[i].neutral + factor * (effect.p[i] - all[i].neutral));
    moved = moved || larger != effect.p[i];
    effect.p[i] = larger;
  }
  return moved;
}

double relative_size(const PlacedEffect& effect, const ArmModel& model) {
  const std::vector<EffectParameter> all = effect.effect->parameters(model.nominal, effect.joint);
  double most = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (is_size(all[i]))
      most = std::max(most, std::abs((effect.p[i] - all[i].neutral) / (all[i].typical - all[i].neutral)));
  return most;
}

std::vector<TrueParameter> true_parameters(const PlacedEffect& effect, const ArmModel& model) {
  const std::vector<EffectParameter> all = effect.effect->parameters(model.nominal, effect.joint);
  bool every_size = true;
  for (std::size_t i = 0; i < all.size(); ++i)
    every_size = every_size && (!is_size(all[i]) || effect.p[i] != all[i].neutral);
  std::vector<TrueParameter> told;
  for (std::size_t i = 0; i < all.size(); ++i)
    told.push_back({all[i].name, effect.p[i], is_size(all[i]) || every_size});
  return told;
}

bool happens_at_an_instant(const PlacedEffect& effect, const ArmModel& model) {
  return std::ranges::any_of(effect.effect->parameters(model.nominal, effect.joint),
                             [](const EffectParameter& p) { return p.range == SearchRange::record_time; });
}

void mistune(ArmParameters<double>& arm, Random& random) {
  Hypothesis h{arm, {}};
  for (const FitParameter& p : baseline_parameters(arm)) set_parameter(h, p, random.uniform(p.lower, p.upper));
  arm = h.nominal;
  for (int k = 0; k < arm.n; ++k) {
    JointParameters<double>& j = arm.joint[k];
    for (double& x : j.com) x *= 1 + j.tolerance.length * random.uniform(-1, 1);
    // One factor for all moments: six of their own need not belong to any body.
    const double factor = 1 + j.tolerance.mass * random.uniform(-1, 1);
    for (double& moment : j.inertia) moment *= factor;
  }
}

}  // namespace halyard::blind

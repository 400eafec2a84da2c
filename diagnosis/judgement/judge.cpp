#include "diagnosis/judgement/judge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/judgement/nested_gain.h"

namespace halyard {
namespace {

/// For the significance of a gain. Blocks with next to no residual, for example while a motor rests, hardly count then.
std::vector<double> floors_beside(const Evidence& evidence, const Score& before) {
  std::vector<double> least = squared_floors(evidence);
  for (std::size_t c = 0; c < least.size(); ++c)
    least[c] += kRule.next_to_none * kRule.next_to_none * before.mean_square[c];
  return least;
}

/// Σ x² or Σ (x - m)² of each deciding block and channel, whichever is less; m: mean of x over the channel. x: one
/// number for each deciding row. [block][2n]
std::vector<std::vector<double>> squares_beside_a_constant(const Evidence& evidence, const std::vector<double>& x) {
  std::vector<std::vector<double>> squares = evidence.block_products(x, x);
  const auto sums = evidence.block_products(x, std::vector<double>(x.size(), 1));
  const auto& count = evidence.block_count();
  for (int c = 0; c < evidence.channels(); ++c) {
    double sum = 0, n = 0;
    for (std::size_t b = 0; b < sums.size(); ++b) sum += sums[b][c], n += count[b][c];
    const double mean = n > 0 ? sum / n : 0;
    for (std::size_t b = 0; b < sums.size(); ++b)
      squares[b][c] -= std::max(0.0, mean * (2 * sums[b][c] - mean * count[b][c]));
  }
  return squares;
}

}  // namespace

Trial unusable(const PlacedEffect& effect) {
  Trial t;
  t.effect = effect;
  return t;
}

std::vector<bool> significant_rest(const Evidence& evidence, const Score& score, const std::vector<double>& misfit) {
  std::vector<bool> rest(evidence.channels(), false);
  for (int c = 0; c < evidence.channels(); ++c)
    rest[c] = evidence.has_channel(c) && score.mean_square[c] > std::pow(kRule.rest_ratio * evidence.floor()[c], 2) +
                                                                    (misfit.empty() ? 0 : misfit[c]);
  return rest;
}

bool is_beyond_noise(const Evidence& evidence, const std::vector<double>& mean_square, int channel) {
  return evidence.has_channel(channel) &&
         mean_square[channel] > std::pow(kRule.explained_ratio * evidence.floor()[channel], 2);
}

std::optional<int> most_explained_channel(const Evidence& evidence, const Score& with, const Score& without) {
  std::optional<int> most;
  double largest = 0;
  for (int c = 0; c < evidence.channels(); ++c) {
    if (!evidence.has_channel(c)) continue;
    const double explained = (without.mean_square[c] - with.mean_square[c]) / std::pow(evidence.floor()[c], 2);
    if (explained > largest) largest = explained, most = c;
  }
  return most;
}

double misfit_of(const PlacedEffect& effect) {
  return effect.effect->stages() == 0 ? kRule.number_misfit : kRule.form_misfit;
}

bool yields_in_the_cable(const PlacedEffect& effect, const ArmParameters<double>& arm) {
  constexpr unsigned kCable =
      static_cast<unsigned>(EffectStage::stretch) | static_cast<unsigned>(EffectStage::cable_force);
  return (effect.effect->stages() & kCable) && !has_instants(effect, arm);
}

bool mends_the_form_of(const PlacedEffect& candidate, const PlacedEffect& found, const ArmParameters<double>& arm) {
  return candidate.joint == found.joint && yields_in_the_cable(candidate, arm) && yields_in_the_cable(found, arm);
}

std::vector<std::vector<double>> misfits(const Evidence& evidence, const Scored& found,
                                         const std::vector<std::size_t>& effects) {
  std::vector<std::vector<double>> all(found.score.block_sum.size(), std::vector<double>(evidence.channels(), 0));
  for (const double misfit : {kRule.form_misfit, kRule.number_misfit}) {
    Hypothesis others = found.hypothesis;
    for (std::size_t i = effects.size(); i-- > 0;)
      if (misfit_of(found.hypothesis.effects[effects[i]]) == misfit) others = without_effect(others, effects[i]);
    if (others.effects.size() == found.hypothesis.effects.size()) continue;
    const Score without = evidence.score(others);
    if (!without.finite) continue;
    const auto done = squares_beside_a_constant(evidence, difference(without.deciding, found.score.deciding));
    for (std::size_t b = 0; b < all.size(); ++b)
      for (std::size_t c = 0; c < all[b].size(); ++c) all[b][c] += misfit * misfit * done[b][c];
  }
  return all;
}

std::vector<double> mean_square_misfit(const Evidence& evidence, const Scored& found,
                                       const std::vector<std::size_t>& effects) {
  std::vector<double> square(evidence.channels(), 0), count(evidence.channels(), 0);
  const auto sums = misfits(evidence, found, effects);
  for (std::size_t b = 0; b < sums.size(); ++b)
    for (std::size_t c = 0; c < square.size(); ++c) {
      square[c] += sums[b][c];
      count[c] += evidence.block_count()[b][c];
    }
  for (std::size_t c = 0; c < square.size(); ++c)
    if (count[c] > 0) square[c] /= count[c];
  return square;
}

std::vector<double> difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t r = 0; r < a.size(); ++r) a[r] -= b[r];
  return a;
}

Judge::Judge(const Evidence& evidence, const ArmModel& model, std::vector<FitParameter> numbers)
    : evidence_(evidence), model_(model), numbers_(std::move(numbers)) {}

Trial Judge::trial(const Hypothesis& with, const Scored& without, std::size_t place) const {
  Trial t = unusable(with.effects[place]);
  const Scored scored{with, evidence_.score(with)};
  if (!scored.score.finite || !without.score.finite) return t;
  t.usable = true;
  t.log_likelihood = log_likelihood(evidence_, scored.score, squared_floors(evidence_));
  t.gain = gain_over(scored, without);
  t.prior_cost = prior_cost(with);
  t.p_value = p_of_gain(scored.score, without.score);
  if (!t.is_judged()) return t;
  t.at_bound = at_bound(scored, place);
  t.is_refit = within_tolerance(with, place);
  t.matters = matters(without, scored, place);
  return t;
}

bool Judge::is_needed(const Scored& with, const Scored& without, std::size_t place, double significance) const {
  return !within_tolerance(with.hypothesis, place) && matters(without, with, place) &&
         p_of_gain(with.score, without.score) <= significance;
}

/// By the scatter of the blocks. For an effect that explains a whole rest, also by the likelihood ratio, so that a few
/// moments are enough.
double Judge::p_of_gain(const Score& with, const Score& without) const {
  const double by_blocks = p_value(paired(nested_gains(evidence_, with, without, floors_beside(evidence_, without))));
  if (!explains_a_rest(without, with)) return by_blocks;
  return std::min(1.0, 2 * std::min(by_blocks, std::exp(-log_likelihood_gain(evidence_, with, without))));
}

double Judge::gain_over(const Scored& a, const Scored& b) const {
  return log_likelihood_gain(evidence_, a.score, b.score) + prior_cost(b.hypothesis) - prior_cost(a.hypothesis);
}

/// True if, in the channel with a rest of which the effect takes most, it leaves nothing that matters, or next to
/// nothing.
bool Judge::explains_a_rest(const Score& before, const Score& after) const {
  const std::vector<bool> had = significant_rest(evidence_, before), has = significant_rest(evidence_, after);
  std::optional<int> most;
  const auto left = [&](int c) { return after.mean_square[c] / before.mean_square[c]; };
  for (int c = 0; c < evidence_.channels(); ++c)
    if (had[c] && (!most || left(c) < left(*most))) most = c;
  return most && (!has[*most] || left(*most) < kRule.next_to_none * kRule.next_to_none);
}

/// Indices of the sizes that end at a bound or whose shape does, and that do more there than one number by chance; the
/// sizes of a push whose instants are both ends of the record or of the motion are among them, and those of a wall that
/// is touched in the whole motion. A group of sizes whose
/// shape is at its bound does not count if it does next to nothing of what the whole effect does: for example a wall at
/// the end of the motion that only improves the form of a tug.
std::vector<std::size_t> Judge::sizes_at_bound(const Scored& with, std::size_t place) const {
  constexpr double kNextToNothing = 0.1;
  const Hypothesis& h = with.hypothesis;
  const auto parameters = effect_parameters(evidence_, h, model_.nominal, place);
  const auto ends = [&](std::size_t i) { return ends_at_bound(parameters[i], parameter_value(h, parameters[i])); };
  const auto shape_ends = [&](std::size_t i) {
    return (ends(i) || is_as_good_at_bound(with, parameters[i])) && acts(with, parameters[i]);
  };
  const auto does = [&](const std::vector<std::size_t>& sizes) {
    Scored without{h, {}};
    for (const std::size_t i : sizes) set_parameter(without.hypothesis, parameters[i], parameters[i].nominal);
    without.score = evidence_.score(without.hypothesis);
    return without.score.finite ? cost(without) - cost(with) : std::numeric_limits<double>::infinity();
  };
  const std::vector<ParameterGroup> groups = groups_of(parameters);
  std::vector<std::size_t> at_bound, all;
  for (const ParameterGroup& group : groups) all.insert(all.end(), group.sizes.begin(), group.sizes.end());
  for (const ParameterGroup& group : groups) {
    const bool lasts = lasts_as_long_as_the_motion(with, parameters, group);
    bool is_whole_group = false;
    if (lasts || acts_in_the_whole_motion(with, parameters, group) || std::ranges::any_of(group.shapes, shape_ends)) {
      const double own = does(group.sizes);
      is_whole_group = own > kRule.by_chance && (lasts || own > kNextToNothing * does(all));
    }
    for (const std::size_t i : group.sizes)
      if (is_whole_group || (ends(i) && does({i}) > kRule.by_chance)) at_bound.push_back(i);
  }
  return at_bound;
}

std::optional<Hypothesis> Judge::without_sizes_at_bound(const Hypothesis& h, std::size_t place,
                                                        std::vector<FitParameter>& given_up) const {
  const std::vector<std::size_t> gone = sizes_at_bound({h, evidence_.score(h)}, place);
  const auto parameters = effect_parameters(evidence_, h, model_.nominal, place);
  const auto is_gone = [&](std::size_t i) { return std::ranges::count(gone, i) > 0; };
  Hypothesis reduced = h;
  bool is_left = false;
  for (const ParameterGroup& group : groups_of(parameters)) {
    for (const std::size_t i : group.sizes) {
      if (is_gone(i)) set_parameter(reduced, parameters[i], parameters[i].nominal), given_up.push_back(parameters[i]);
      else is_left = is_left || parameter_value(h, parameters[i]) != parameters[i].nominal;
    }
    if (std::ranges::all_of(group.sizes, is_gone))
      for (const std::size_t i : group.shapes) given_up.push_back(parameters[i]);
  }
  return !gone.empty() && is_left ? std::optional(reduced) : std::nullopt;
}

/// False for a shape that may as well have any of the values at which it is looked for: the size that it belongs to is
/// not there.
bool Judge::acts(const Scored& with, const FitParameter& shape) const {
  const std::vector<double> ends = {shape.lower, shape.upper};
  return std::ranges::any_of(shape.starts.empty() ? ends : shape.starts, [&](double value) {
    Scored there{with.hypothesis, {}};
    set_parameter(there.hypothesis, shape, value);
    there.score = evidence_.score(there.hypothesis);
    return !there.score.finite || std::abs(cost(there) - cost(with)) > kRule.by_chance;
  });
}

/// True for a wall that is touched in nearly the whole motion.
bool Judge::acts_in_the_whole_motion(const Scored& with, const std::vector<FitParameter>& parameters,
                                     const ParameterGroup& group) const {
  constexpr double kNearly = 0.05;  // of the motion
  return std::ranges::any_of(group.shapes, [&](std::size_t i) {
    const FitParameter& position = parameters[i];
    if (!position.is_wall || group.sizes.empty()) return false;
    const double size = parameter_value(with.hypothesis, parameters[group.sizes[0]]);
    const double value = parameter_value(with.hypothesis, position);
    const double outside = size > 0 ? value - position.lower : position.upper - value;
    return size != 0 && outside < kNearly * (position.upper - position.lower);
  });
}

/// True for an effect between two instants that acts all the time or all the time that the arm moves, nearly, or as
/// well might: it is an offset or belongs to the motion, which other effects explain.
bool Judge::lasts_as_long_as_the_motion(const Scored& with, const std::vector<FitParameter>& parameters,
                                        const ParameterGroup& group) const {
  constexpr double kNearly = 0.05;  // of the time
  const std::vector<FitParameter> instants = instants_of(parameters, group);
  if (instants.size() != 2) return false;
  const auto begins_and_ends_with = [&](const Span& span) {
    Scored there = with;
    double off = 0;
    for (const auto& [instant, end] : {std::pair(&instants[0], span.first), std::pair(&instants[1], span.last)}) {
      off += std::abs(parameter_value(with.hypothesis, *instant) - end);
      set_parameter(there.hypothesis, *instant, end);
    }
    if (off < kNearly * (span.last - span.first)) return true;
    there.score = evidence_.score(there.hypothesis);
    return there.score.finite && cost(there) < cost(with) + kRule.by_chance;
  };
  return begins_and_ends_with(evidence_.time_span()) || begins_and_ends_with(evidence_.moving_span());
}

/// True if a shape is near the end of what is plausible, and the data cannot tell it from there.
bool Judge::is_as_good_at_bound(const Scored& with, const FitParameter& p) const {
  constexpr double kNear = 2;  // times
  if (p.natural_bounds || p.is_whole || p.range != SearchRange::own) return false;
  const double value = parameter_value(with.hypothesis, p);
  for (const double bound : {p.lower, p.upper}) {
    if (bound == p.nominal || !(value * bound > 0) || std::abs(std::log(value / bound)) > std::log(kNear)) continue;
    Scored there{with.hypothesis, {}};
    set_parameter(there.hypothesis, p, bound);
    there.score = evidence_.score(there.hypothesis);
    if (there.score.finite && cost(there) < cost(with) + kRule.by_chance) return true;
  }
  return false;
}

/// True if all sizes of the effect stay within the tolerances of the numbers that they change: a refit and no effect.
bool Judge::within_tolerance(const Hypothesis& h, std::size_t place) const {
  const PlacedEffect& e = h.effects[place];
  const auto parameters = e.effect->parameters(model_.nominal, e.joint);
  const SearchSpace space = search_space(*e.effect, model_.nominal, e.joint);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const EffectParameter& p = parameters[i];
    const TolerancedNumber& number = space.parameters[i].changes;
    const double tolerance = number.kind ? model_.joints[number.joint].tolerances.*number.kind * number.size : 0;
    // Of a number without tolerance a hundredth of its typical size is nothing.
    const double allowed = tolerance > 0 ? tolerance : 0.01 * std::abs(p.typical - p.neutral);
    if (!p.is_shape() && std::abs(e.p[i] - p.neutral) > allowed) return false;
  }
  return true;
}

Judge::FoundMisfits Judge::misfits_beside(const Scored& without, const PlacedEffect& candidate) const {
  std::vector<std::size_t> all, elsewhere;
  for (std::size_t e = model_.effects.size(); e < without.hypothesis.effects.size(); ++e) {
    all.push_back(e);
    if (!mends_the_form_of(candidate, without.hypothesis.effects[e], model_.nominal)) elsewhere.push_back(e);
  }
  FoundMisfits m{misfits(evidence_, without, all), {}};
  m.elsewhere = elsewhere.size() == all.size() ? m.all : misfits(evidence_, without, elsewhere);
  return m;
}

/// True if the effect takes a share of the residual that is more than the misfit of what was named before it. Where the
/// earlier effects do little, their misfit is small as well. Therefore blocks in which their misfit may be larger than
/// the channel's residual do not count, and a small effect is seen where a large one does not act. The residual of the
/// whole channel decides this and not that of the block: otherwise the blocks in which a misfit is large by chance
/// would be kept. All blocks count beside an effect whose form the candidate could mend: its fit has spread the misfit
/// over all of them.
bool Judge::takes_a_share(const Score& before, const Score& after, const FoundMisfits& misfits, int c) const {
  double all = 0, gain = 0, misfit = 0;  // sums of squares
  for (std::size_t b = 0; b < before.block_sum.size(); ++b) {
    const double had = before.block_sum[b][c];
    all += had;
    if (misfits.elsewhere[b][c] > before.mean_square[c] * evidence_.block_count()[b][c]) continue;
    gain += had - after.block_sum[b][c];
    misfit += misfits.all[b][c];
  }
  return gain > std::max(kRule.share * all, misfit);
}

/// The effect takes a share of a residual that noise does not explain, or relieves the model's numbers. It also changes
/// some signal by much more than the sensor resolves. The deciding blocks have to show such a residual. Otherwise,
/// after one burst in the fitting blocks, an effect would count for what it does elsewhere below the noise.
bool Judge::matters(const Scored& without, const Scored& with, std::size_t place) const {
  bool counts = prior_cost(without.hypothesis) - prior_cost(with.hypothesis) > kRule.relief;
  const FoundMisfits before = misfits_beside(without, with.hypothesis.effects[place]);
  for (int c = 0; c < evidence_.channels() && !counts; ++c)
    counts =
        is_beyond_noise(evidence_, without.score.mean_square, c) && takes_a_share(without.score, with.score, before, c);
  if (!counts) return false;
  const auto rows = evidence_.fit_rows({with.hypothesis, without_effect(with.hypothesis, place)});
  return !rows[0].empty() &&
         (rows[1].empty() || evidence_.exceeds_floor(difference(rows[0], rows[1]), kRule.above_floor));
}

bool Judge::leans_on_a_bound(const Scored& found) const {
  for (std::size_t e = model_.effects.size(); e < found.hypothesis.effects.size(); ++e)
    if (at_bound(found, e)) return true;
  return false;
}

double Judge::prior_cost(const Hypothesis& h) const {
  double sum = 0;
  for (const FitParameter& b : numbers_) {
    const double u = (parameter_value(h, b) - b.nominal) / b.scale;
    sum += 0.5 * u * u;
  }
  return sum;
}

double Judge::cost(const Scored& scored) const {
  double sum = prior_cost(scored.hypothesis);
  for (int c = 0; c < evidence_.channels(); ++c)
    if (evidence_.has_channel(c))
      sum -= block_log_likelihood(evidence_, c, evidence_.fit_count(c), scored.score.fit_mean_square[c],
                                  std::pow(evidence_.floor()[c], 2));
  return sum;
}

}  // namespace halyard

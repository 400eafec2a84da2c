#include "diagnosis/search/pair_rivals.h"

#include <algorithm>
#include <utility>

#include "diagnosis/judgement/name_probability.h"
#include "diagnosis/prediction/side_by_side.h"

namespace halyard {
namespace {

/// Rivals of a name that are tried with those of the other name.
constexpr std::size_t kMostRivals = 2;

/// The candidates at the joint of the effect that gained nearly as much as it, the closest first, as they were fitted.
std::vector<PlacedEffect> rivals_of(const PlacedEffect& effect, const Hypothesis& found,
                                    const std::vector<Round>& rounds) {
  std::vector<std::pair<double, PlacedEffect>> all;
  for (const Round& round : rounds) {
    if (round.at_once || round.trials.empty() || !same_name(round.trials[0].effect, effect)) continue;
    for (const Trial& t : round.trials) {
      if (!t.is_judged() || t.is_refit || t.is_another || t.effect.joint != effect.joint) continue;
      const bool is_found = std::ranges::any_of(found.effects, [&](const auto& e) { return same_name(e, t.effect); });
      const double share = t.gain / round.trials[0].gain;
      if (!is_found && share >= kRule.shared_gain) all.emplace_back(share, t.effect);
    }
  }
  std::ranges::stable_sort(all, std::ranges::greater{}, [](const auto& a) { return a.first; });
  std::vector<PlacedEffect> rivals;
  for (const std::pair<double, PlacedEffect>& a : all)
    if (rivals.size() < kMostRivals &&
        std::ranges::none_of(rivals, [&](const PlacedEffect& r) { return same_name(r, a.second); }))
      rivals.push_back(a.second);
  return rivals;
}

/// The share `weight` of what told a name, to which others come.
void shrink(Naming& naming, double weight) {
  naming.weight *= weight;
  for (Alternative& a : naming.alternatives) a.probability *= weight;
}

void add_alternative(Naming& naming, const PlacedEffect& effect, double weight) {
  const auto same =
      std::ranges::find_if(naming.alternatives, [&](const Alternative& a) { return same_name(a.effect, effect); });
  if (same != naming.alternatives.end()) same->probability += weight;
  else naming.alternatives.push_back({effect, weight, false});
  std::ranges::stable_sort(naming.alternatives, std::ranges::greater{}, &Alternative::probability);
}

/// The alternative becomes the name, and the name an alternative.
void exchange(Naming& naming, const PlacedEffect& name, const PlacedEffect& by) {
  const auto its =
      std::ranges::find_if(naming.alternatives, [&](const Alternative& a) { return same_name(a.effect, by); });
  const double weight = its->probability;
  naming.alternatives.erase(its);
  add_alternative(naming, name, std::exchange(naming.weight, weight));
  naming.surer.reset();
}

Hypothesis without_both(const Hypothesis& h, const PairRivals::Places& places) {
  return without_effect(without_effect(h, places.second), places.first);
}

}  // namespace

/// Two effects, the last of the hypothesis of their fit.
struct PairRivals::Pair {
  PlacedEffect first, second;
  Fit fit;
  Score score;
};

void PairRivals::fit(Pair& pair, const Hypothesis& without, const Score& before) const {
  const Hypothesis start = refitter_.with_effect(refitter_.with_effect(without, pair.first), pair.second);
  pair.fit = refitter_.refit(start, before);
  if (pair.fit.usable) pair.score = evidence_.score(pair.fit.hypothesis);
}

/// Each beside the other.
bool PairRivals::can_be_named(const Pair& pair) const {
  const Hypothesis& h = pair.fit.hypothesis;
  for (const std::size_t place : {h.effects.size() - 2, h.effects.size() - 1}) {
    const Fit left = refitter_.refit(without_effect(h, place), pair.score);
    if (!left.usable) return false;
    if (!judge_.trial(h, {left.hypothesis, evidence_.score(left.hypothesis)}, place).passes(significance_))
      return false;
  }
  return true;
}

/// Pairs that can be integrated.
std::vector<PairRivals::Pair> PairRivals::pairs(const Attribution& found, const Places& places) const {
  const Hypothesis& h = found.final_fit.hypothesis;
  std::vector<Pair> all;
  for (const PlacedEffect& first : rivals_of(h.effects[places.first], h, found.rounds))
    for (const PlacedEffect& second : rivals_of(h.effects[places.second], h, found.rounds))
      if (!same_name(first, second)) all.push_back({first, second, {}, {}});
  run_side_by_side(all.size(), [&](std::size_t i) { fit(all[i], without_both(h, places), found.final_score); });
  std::erase_if(all, [](const Pair& p) { return !p.fit.usable || !p.score.finite; });
  return all;
}

/// Of the two names, then of the pairs, then of no effect.
std::vector<double> PairRivals::weights(const Attribution& found, const Places& places, const Hypothesis& neither,
                                        const std::vector<Pair>& pairs) const {
  const auto numbers = [&](const PlacedEffect& a, const PlacedEffect& b) {
    return numbers_added(a, model_.nominal) + numbers_added(b, model_.nominal);
  };
  const std::vector<double> least = squared_floors(evidence_);
  const Hypothesis& h = found.final_fit.hypothesis;
  const Likelihood of_names = log_likelihood(evidence_, found.final_score, least);
  const Likelihood of_neither = log_likelihood(evidence_, evidence_.score(neither), least);
  std::vector<Likelihood> of_pairs;
  for (const Pair& p : pairs) of_pairs.push_back(log_likelihood(evidence_, p.score, least));
  std::vector<Competitor> all = {
      {&of_names, numbers(h.effects[places.first], h.effects[places.second]), judge_.stretch(h)}};
  for (std::size_t i = 0; i < pairs.size(); ++i)
    all.push_back({&of_pairs[i], numbers(pairs[i].first, pairs[i].second), judge_.stretch(pairs[i].fit.hypothesis)});
  return name_weights(evidence_, all, {&of_neither, 0, judge_.stretch(neither)});
}

void PairRivals::weigh(Attribution& found, const Places& places) const {
  const std::vector<Pair> rivals = pairs(found, places);
  if (rivals.empty()) return;
  const Fit neither = refitter_.refit(without_both(found.final_fit.hypothesis, places), found.final_score);
  if (!neither.usable) return;
  const std::vector<double> weight = weights(found, places, neither.hypothesis, rivals);
  Naming& first = found.namings[places.first - given_];
  Naming& second = found.namings[places.second - given_];
  shrink(first, weight[0]), shrink(second, weight[0]);
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    add_alternative(first, rivals[i].first, weight[i + 1]);
    add_alternative(second, rivals[i].second, weight[i + 1]);
  }
  const auto best = std::max_element(weight.begin(), weight.end() - 1) - weight.begin();
  if (best > 0 && can_be_named(rivals[static_cast<std::size_t>(best - 1)]))
    rename(found, places, rivals[static_cast<std::size_t>(best - 1)]);
}

/// The pair takes the place of the two names.
void PairRivals::rename(Attribution& found, const Places& places, const Pair& pair) const {
  const std::vector<PlacedEffect>& old = found.final_fit.hypothesis.effects;
  Naming first = found.namings[places.first - given_], second = found.namings[places.second - given_];
  exchange(first, old[places.first], pair.first);
  exchange(second, old[places.second], pair.second);
  found.namings.erase(found.namings.begin() + static_cast<std::ptrdiff_t>(places.second - given_));
  found.namings.erase(found.namings.begin() + static_cast<std::ptrdiff_t>(places.first - given_));
  found.namings.push_back(std::move(first));
  found.namings.push_back(std::move(second));
  found.final_fit = pair.fit;
  found.final_score = pair.score;
}

void PairRivals::weigh(Attribution& found) const {
  const std::size_t n = found.final_fit.hypothesis.effects.size();
  for (std::size_t second = given_; second < n; ++second)
    for (std::size_t first = given_; first < second; ++first) {
      const std::vector<PlacedEffect>& effects = found.final_fit.hypothesis.effects;
      if (effects[first].joint && effects[first].joint == effects[second].joint) weigh(found, {first, second});
    }
}

}  // namespace halyard

#include "diagnosis/search/pair_rivals.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "diagnosis/judgement/name_probability.h"
#include "diagnosis/prediction/side_by_side.h"
#include "diagnosis/round/essence.h"

namespace halyard {
namespace {

/// Rivals of a name that are tried with those of the other name, and with each other.
constexpr std::size_t kMostRivals = 2, kMostRivalsOfOne = 3;
/// Each effect of a pair that would replace one name is an alternative of it: they share the weight of the pair.
constexpr double kShareOfOne = 0.5;

/// The candidate that led a round: the name that stays, or the one that has won or gained most.
const Trial* leader_of(const Round& round) {
  if (round.at_once || round.trials.empty()) return nullptr;
  if (!round.name_stays) return &round.trials[0];
  const auto name =
      std::ranges::find_if(round.trials, [&](const Trial& t) { return same_name(t.effect, *round.revised); });
  return name != round.trials.end() ? &*name : nullptr;
}

/// The candidates at the joint of the effect that gained nearly as much as it, the closest first, as they were fitted.
/// Rounds with other tolerances say nothing about names within the present ones.
std::vector<PlacedEffect> rivals_of(const PlacedEffect& effect, const Hypothesis& found,
                                    const std::vector<Round>& rounds, std::size_t most) {
  std::vector<std::pair<double, PlacedEffect>> all;
  for (const Round& round : rounds) {
    if (round.tolerance_factor) all.clear();
    const Trial* const leader = leader_of(round);
    if (!leader || !same_name(leader->effect, effect) || leader->gain <= 0) continue;
    for (const Trial& t : round.trials) {
      if (!t.is_judged() || t.is_refit || t.is_another || t.effect.joint != effect.joint) continue;
      const bool is_found = std::ranges::any_of(found.effects, [&](const auto& e) { return same_name(e, t.effect); });
      const double share = t.gain / leader->gain;
      if (!is_found && share >= kRule.shared_gain) all.emplace_back(share, t.effect);
    }
  }
  std::ranges::stable_sort(all, std::ranges::greater{}, [](const auto& a) { return a.first; });
  std::vector<PlacedEffect> rivals;
  for (const std::pair<double, PlacedEffect>& a : all)
    if (rivals.size() < most &&
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

/// Takes the alternative from the naming and returns its probability; 0: it is none.
double take(Naming& naming, const PlacedEffect& effect) {
  const auto its =
      std::ranges::find_if(naming.alternatives, [&](const Alternative& a) { return same_name(a.effect, effect); });
  if (its == naming.alternatives.end()) return 0;
  const double probability = its->probability;
  naming.alternatives.erase(its);
  return probability;
}

/// A new name with this weight; `name` becomes an alternative.
void rename_to(Naming& naming, const PlacedEffect& name, double weight) {
  add_alternative(naming, name, std::exchange(naming.weight, weight));
  naming.surer.reset();
}

Hypothesis without_effects(Hypothesis h, const std::vector<std::size_t>& places) {
  for (std::size_t i = places.size(); i-- > 0;) h = without_effect(std::move(h), places[i]);
  return h;
}

/// Places of names after those at `gone` have been removed; without those that have lost one.
std::vector<std::vector<std::size_t>> left_after(const std::vector<std::size_t>& gone,
                                                 std::vector<std::vector<std::size_t>> all) {
  std::erase_if(all, [&](const auto& places) { return std::ranges::find_first_of(places, gone) != places.end(); });
  for (std::vector<std::size_t>& places : all)
    for (std::size_t& place : places)
      place -= static_cast<std::size_t>(std::ranges::count_if(gone, [&](std::size_t g) { return g < place; }));
  return all;
}

}  // namespace

/// Two effects, the last of the hypothesis of their fit.
struct PairRivals::Pair {
  PlacedEffect first, second;
  Fit fit;
  Score score;
};

/// One or two names against the pairs of their rivals.
struct PairRivals::Contest {
  Places places;
  std::vector<Pair> pairs;
  Fit none;  ///< without the names
};

/// Each beside the other.
bool PairRivals::can_be_named(const Pair& pair) const {
  const Hypothesis& h = pair.fit.hypothesis;
  const std::size_t places[] = {h.effects.size() - 2, h.effects.size() - 1};
  bool can[] = {false, false};
  run_side_by_side(std::size(places), [&](std::size_t i) {
    const std::optional<Scored> left = refitter_.refitted(without_effect(h, places[i]), pair.score);
    can[i] = left && judge_.trial(h, *left, places[i]).passes(options_.significance) &&
             !is_another_effect(evidence_, refitter_, judge_, {h, pair.score}, places[i]);
  });
  return can[0] && can[1];
}

/// Not fitted yet.
std::vector<PairRivals::Pair> PairRivals::pairs(const Attribution& found, const Places& places) const {
  const Hypothesis& h = found.final_fit.hypothesis;
  const auto rivals = [&](std::size_t place, std::size_t most) {
    return rivals_of(h.effects[place], h, found.rounds, most);
  };
  std::vector<Pair> all;
  if (places.size() == 1) {
    const std::vector<PlacedEffect> its = rivals(places[0], kMostRivalsOfOne);
    for (std::size_t second = 1; second < its.size(); ++second)
      for (std::size_t first = 0; first < second; ++first) all.push_back({its[first], its[second], {}, {}});
  } else {
    for (const PlacedEffect& first : rivals(places[0], kMostRivals))
      for (const PlacedEffect& second : rivals(places[1], kMostRivals))
        if (!same_name(first, second)) all.push_back({first, second, {}, {}});
  }
  return all;
}

/// All fits side by side. Pairs that cannot be integrated are left out.
std::vector<PairRivals::Contest> PairRivals::contests(const Attribution& found,
                                                      const std::vector<Places>& of_names) const {
  std::vector<Contest> all;
  for (const Places& places : of_names) all.push_back({places, pairs(found, places), {}});
  const auto without = [&](const Contest& c) { return without_effects(found.final_fit.hypothesis, c.places); };
  std::vector<std::function<void()>> fits;
  for (Contest& c : all) {
    for (Pair& pair : c.pairs)
      fits.emplace_back([&] {
        const Hypothesis start = refitter_.with_effect(refitter_.with_effect(without(c), pair.first), pair.second);
        pair.fit = refitter_.refit(start, found.final_score);
        if (pair.fit.usable) pair.score = evidence_.score(pair.fit.hypothesis);
      });
    if (!c.pairs.empty()) fits.emplace_back([&] { c.none = refitter_.refit(without(c), found.final_score); });
  }
  run_side_by_side(fits.size(), [&](std::size_t i) { fits[i](); });
  for (Contest& c : all) std::erase_if(c.pairs, [](const Pair& p) { return !p.fit.usable || !p.score.finite; });
  return all;
}

/// Of the names, then of the pairs, then of no effect. none: the hypothesis without the names.
std::vector<double> PairRivals::weights(const Attribution& found, const Places& places, const Hypothesis& none,
                                        const std::vector<Pair>& pairs) const {
  const auto cost = [&](const PlacedEffect& e) { return prior_cost_of(e, model_.nominal); };
  const std::vector<double> least = squared_floors(evidence_);
  const Hypothesis& h = found.final_fit.hypothesis;
  const Likelihood of_names = log_likelihood(evidence_, found.final_score, least);
  const Likelihood of_none = log_likelihood(evidence_, evidence_.score(none), least);
  std::vector<Likelihood> of_pairs;
  for (const Pair& p : pairs) of_pairs.push_back(log_likelihood(evidence_, p.score, least));
  std::vector<Competitor> all = {{&of_names, judge_.prior_cost(h)}};
  for (const std::size_t place : places) all[0].prior_cost += cost(h.effects[place]);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Scored fitted{pairs[i].fit.hypothesis, pairs[i].score};
    double prior_cost = cost(pairs[i].first) + cost(pairs[i].second) + judge_.prior_cost(fitted.hypothesis);
    for (const std::size_t place : {fitted.hypothesis.effects.size() - 2, fitted.hypothesis.effects.size() - 1})
      if (judge_.at_bound(fitted, place)) prior_cost += kRule.at_bound;
    all.push_back({&of_pairs[i], prior_cost});
  }
  return name_weights(evidence_, all, {&of_none, judge_.prior_cost(none)});
}

/// An effect of the pair, which cannot be named, may be more probable than the name. The alternatives are in the order
/// of their probability.
void PairRivals::doubt(Naming& naming, const Pair& pair) {
  for (const Alternative& a : naming.alternatives) {
    if (a.probability <= naming.weight || (naming.surer && same_name(a.effect, *naming.surer))) return;
    if (same_name(a.effect, pair.first) || same_name(a.effect, pair.second)) {
      naming.surer = a.effect;
      return;
    }
  }
}

/// True if a pair has taken the place of the names.
bool PairRivals::weigh(Attribution& found, const Contest& contest) const {
  const auto& [places, rivals, none] = contest;
  if (rivals.empty() || !none.usable) return false;
  const std::vector<double> weight = weights(found, places, none.hypothesis, rivals);
  for (const std::size_t place : places) shrink(found.namings[place - given_], weight[0]);
  const auto best = static_cast<std::size_t>(std::max_element(weight.begin(), weight.end() - 1) - weight.begin());
  if (best == 0 || !can_be_named(rivals[best - 1])) {
    add_alternatives(found, places, rivals, weight);
    if (best != 0)
      for (const std::size_t place : places) doubt(found.namings[place - given_], rivals[best - 1]);
    return false;
  }
  take_the_place(found, places, rivals, weight, best - 1);
  return true;
}

/// The effects of the pairs that replace one name are alternatives of it, and so are those that replace one of two
/// names.
void PairRivals::add_alternatives(Attribution& found, const Places& places, const std::vector<Pair>& pairs,
                                  const std::vector<double>& weight) const {
  Naming& first = found.namings[places.front() - given_];
  Naming& second = found.namings[places.back() - given_];
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double share = weight[i + 1] * (places.size() == 1 ? kShareOfOne : 1);
    add_alternative(first, pairs[i].first, share);
    add_alternative(second, pairs[i].second, share);
  }
}

/// The naming of one effect of the pair that takes the place of a name. Each pair with the effect counts for it. In a
/// pair with only the other one, what stands beside that is an alternative; of a pair with neither, both are.
Naming PairRivals::naming_of(const PlacedEffect& effect, const PlacedEffect& other, const std::vector<Pair>& pairs,
                             const std::vector<double>& weight, Naming naming, const PlacedEffect& before) {
  rename_to(naming, before, 0);
  // What each of the pair weighed alone: the effect is named now, and beside the other one it is not needed.
  naming.weight = take(naming, effect);
  take(naming, other);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PlacedEffect &first = pairs[i].first, &second = pairs[i].second;
    const auto has = [&](const PlacedEffect& e) { return same_name(first, e) || same_name(second, e); };
    if (has(effect)) {
      naming.weight += weight[i + 1];
      continue;
    }
    for (const PlacedEffect& e : {first, second})
      if (!same_name(e, other)) add_alternative(naming, e, weight[i + 1] * (has(other) ? 1 : kShareOfOne));
  }
  return naming;
}

void PairRivals::take_the_place(Attribution& found, const Places& places, const std::vector<Pair>& pairs,
                                const std::vector<double>& weight, std::size_t best) const {
  const Pair& pair = pairs[best];
  const std::vector<PlacedEffect>& old = found.final_fit.hypothesis.effects;
  Naming first, second;
  if (places.size() == 1) {
    const Naming& before = found.namings[places[0] - given_];
    first = naming_of(pair.first, pair.second, pairs, weight, before, old[places[0]]);
    second = naming_of(pair.second, pair.first, pairs, weight, before, old[places[0]]);
  } else {
    add_alternatives(found, places, pairs, weight);
    first = found.namings[places[0] - given_], second = found.namings[places[1] - given_];
    rename_to(first, old[places[0]], take(first, pair.first));
    rename_to(second, old[places[1]], take(second, pair.second));
  }
  for (std::size_t i = places.size(); i-- > 0;)
    found.namings.erase(found.namings.begin() + static_cast<std::ptrdiff_t>(places[i] - given_));
  found.namings.push_back(std::move(first));
  found.namings.push_back(std::move(second));
  found.final_fit = pair.fit;
  found.final_score = pair.score;
}

void PairRivals::weigh(Attribution& found) const {
  const auto n_effects = [&] { return found.final_fit.hypothesis.effects.size(); };
  std::vector<Places> names;
  for (std::size_t place = given_; place < n_effects(); ++place) names.push_back({place});
  decide(found, std::move(names));
  std::vector<Places> twos;
  const std::vector<PlacedEffect>& effects = found.final_fit.hypothesis.effects;
  for (std::size_t second = given_ + 1; second < n_effects(); ++second)
    for (std::size_t first = given_; first < second; ++first)
      if (effects[first].joint && effects[first].joint == effects[second].joint) twos.push_back({first, second});
  decide(found, std::move(twos));
}

/// One contest after the other. A pair that wins goes to the end of the effects, where nothing is asked about it, and
/// changes what the others are fitted beside.
void PairRivals::decide(Attribution& found, std::vector<Places> of_names) const {
  const std::size_t most = given_ + static_cast<std::size_t>(options_.most_effects);
  while (!of_names.empty()) {
    std::erase_if(of_names, [&](const Places& places) {
      return places.size() == 1 && found.final_fit.hypothesis.effects.size() >= most;
    });
    const std::vector<Contest> all = contests(found, of_names);
    const auto won = std::ranges::find_if(all, [&](const Contest& c) { return weigh(found, c); });
    if (won == all.end()) return;
    of_names = left_after(won->places, {of_names.begin() + (won - all.begin()) + 1, of_names.end()});
  }
}

}  // namespace halyard

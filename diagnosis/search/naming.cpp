#include "diagnosis/search/naming.h"

#include <algorithm>

#include "diagnosis/judgement/false_discovery.h"
#include "diagnosis/judgement/name_probability.h"
#include "diagnosis/round/essence.h"

namespace halyard {

double probability_of_any_name(const Naming& naming, double none) {
  double sum = naming.weight;
  for (const Alternative& a : naming.alternatives) sum += a.probability;
  return (1 - none) * sum;
}

double told_probability(double weight, double none) { return kRule.right_if_certain * weight * (1 - none); }

double prior_cost_of(const PlacedEffect& effect, const ArmParameters<double>& arm) {
  const std::size_t numbers =
      effect.effect->parameters(arm, effect.joint).size() + (effect.effect->stages() != 0 ? 1 : 0);
  return kRule.cost_of_effect + kRule.cost_of_number * static_cast<double>(numbers);
}

std::vector<bool> convincing(const std::vector<Trial>& trials, double significance) {
  std::vector<double> p;
  for (const Trial& t : trials)
    if (t.is_fitted) p.push_back(t.can_be_named() ? t.p_value : 1.0);
  const std::vector<double> rate = false_discovery_rates(p);
  std::vector<bool> is(trials.size(), false);
  for (std::size_t i = 0, next = 0; i < trials.size(); ++i)
    if (trials[i].is_fitted) is[i] = rate[next++] < significance;
  return is;
}

Competition::Competition(const Evidence& evidence, const ArmModel& model, const Judge& judge, const Scored& without,
                         const std::vector<Trial>& trials)
    : evidence_(evidence),
      model_(model),
      judge_(judge),
      without_(without),
      trials_(trials),
      ln_without_(log_likelihood(evidence, without.score, squared_floors(evidence))) {}

Competition::Choice Competition::choose(const std::vector<std::size_t>& able) const {
  const std::size_t best = *std::ranges::max_element(able, {}, [&](std::size_t i) { return trials_[i].gain; });
  std::vector<std::size_t> alike = {best};
  for (const std::size_t i : able) {
    if (i == best) continue;
    const Paired p = paired(evidence_, trials_[best].log_likelihood, trials_[i].log_likelihood);
    if (shared_gain(trials_[best].log_likelihood, trials_[i].log_likelihood, ln_without_) < kRule.shared_gain) continue;
    if (p.t < kRule.tell_apart || p.sum < 2 * kRule.tell_apart * kRule.tell_apart) alike.push_back(i);
  }
  // Of the candidates that the data cannot distinguish, the most probable is named.
  const std::vector<double> weight = weights(alike);
  const auto most = std::ranges::max_element(weight.begin(), weight.end() - 1);
  return {alike[static_cast<std::size_t>(most - weight.begin())], alike};
}

Naming Competition::naming(const Choice& choice) const {
  constexpr double kWorthTelling = 0.01;
  std::vector<std::size_t> rivals = {choice.named};
  for (std::size_t i = 0; i < trials_.size(); ++i) {
    const Trial& t = trials_[i];
    if (i == choice.named || !t.is_judged() || t.is_refit || t.gain <= 0) continue;
    if (t.is_another && !becomes(t.effect, trials_[choice.named].effect, model_.nominal)) continue;
    if (shared_gain(trials_[choice.named].log_likelihood, t.log_likelihood, ln_without_) >= kRule.shared_gain)
      rivals.push_back(i);
  }
  const std::vector<double> weight = weights(rivals);
  Naming naming;
  naming.weight = weight[0];
  double surest = naming.weight;
  for (std::size_t r = 1; r < rivals.size(); ++r) {
    const Trial& t = trials_[rivals[r]];
    if (!t.can_be_named() && !t.is_another && weight[r] > surest) surest = weight[r], naming.surer = t.effect;
    if (weight[r] > kWorthTelling || std::ranges::count(choice.alike, rivals[r]) > 0)
      naming.alternatives.push_back({t.effect, weight[r], false});
  }
  std::ranges::stable_sort(naming.alternatives, std::ranges::greater{}, &Alternative::probability);
  return naming;
}

double Competition::weight_of_no_effect() const {
  std::vector<std::size_t> rivals;
  for (std::size_t i = 0; i < trials_.size(); ++i)
    if (trials_[i].can_be_named()) rivals.push_back(i);
  return weights(rivals).back();
}

/// Of the rivals, then of no effect.
std::vector<double> Competition::weights(const std::vector<std::size_t>& rivals) const {
  std::vector<Competitor> all;
  for (const std::size_t i : rivals) {
    const Trial& t = trials_[i];
    // At its bound an effect is less plausible, but may still be the right one. One that is the name, the first of the
    // rivals, at an end of its shapes does not explain significantly more: what it gains above the name is chance.
    const Trial& as = t.is_another && t.gain > trials_[rivals.front()].gain ? trials_[rivals.front()] : t;
    const double implausible = (t.at_bound ? kRule.at_bound : 0) + (t.is_another ? kRule.cost_of_a_limit : 0);
    all.push_back({&as.log_likelihood, prior_cost_of(t.effect, model_.nominal) + as.prior_cost + implausible});
  }
  return name_weights(evidence_, all, {&ln_without_, judge_.prior_cost(without_.hypothesis)});
}

}  // namespace halyard

#include "diagnosis/search/compete.h"

#include <algorithm>

#include "diagnosis/round/essence.h"

namespace halyard {
namespace {

bool may_repeat(const PlacedEffect& e, const ArmParameters<double>& arm) {
  return has_instants(e, arm) || search_space(*e.effect, arm, e.joint).order_of_motor_torque;
}

/// True if the fit `to` may replace the fit `from` of the same candidate: it costs less, by more than chance does.
bool is_worth_a_change(const Judge& judge, const Scored& from, const Scored& to) {
  return judge.cost(to) + kRule.worth_a_change <= judge.cost(from);
}

/// The trial of the standing name, if it competes with the fit that it has. its: its trial with this fit.
std::optional<std::size_t> keep_standing(const Evidence& evidence, const Judge& judge, const Found& found,
                                         const Trial& its, std::vector<Trial>& trials, std::vector<Fit>& fits) {
  const auto same = std::ranges::find_if(trials, [&](const Trial& t) { return same_name(t.effect, its.effect); });
  if (same == trials.end()) {
    trials.push_back(its);
    fits.push_back(found.fit);
    return trials.size() - 1;
  }
  const auto place = static_cast<std::size_t>(same - trials.begin());
  Fit& fit = fits[place];
  if (fit.usable) {
    const Scored anew{fit.hypothesis, evidence.score(fit.hypothesis)};
    if (is_worth_a_change(judge, found.scored(), anew)) return {};
  }
  *same = its;
  fit = found.fit;
  return place;
}

/// The trial of a name beside the other effects, with the fit that it has.
Trial trial_of(const Evidence& evidence, const Basis& basis, const Standing& name, const Scored& without) {
  const Hypothesis& h = name.found.fit.hypothesis;
  Trial t = basis.judge.trial(h, without, name.place);
  if (t.can_be_named())
    t.is_another = is_another_effect(evidence, basis.refitter, basis.judge, {h, name.found.score}, name.place);
  return t;
}

/// What each candidate has found, in the order of the trials.
struct Field {
  const Evidence& evidence;
  const Basis& basis;
  const Scored& without;
  std::vector<Trial>& trials;
  std::vector<Fit>& fits;
};

/// Fits candidate i once more from `start`, with the weights of the score `before`. Returns true if that fit is better:
/// then it stays.
bool refit_from(const Hypothesis& start, const Score& before, std::size_t i, const Field& field) {
  const auto& [evidence, basis, without, trials, fits] = field;
  const Found found = basis.refitted(start, before);
  if (!found.fit.usable || !found.score.finite) return false;
  if (fits[i].usable) {
    const Scored present{fits[i].hypothesis, evidence.score(fits[i].hypothesis)};
    if (!is_worth_a_change(basis.judge, present, found.scored())) return false;
  }
  trials[i] = trial_of(evidence, basis, {found, found.fit.hypothesis.effects.size() - 1}, without);
  fits[i] = found.fit;
  return true;
}

std::size_t place_of(const PlacedEffect& effect, const Hypothesis& h) {
  const auto its = std::ranges::find_if(h.effects, [&](const PlacedEffect& e) { return same_name(e, effect); });
  return static_cast<std::size_t>(its - h.effects.begin());
}

/// Candidate `one` is the candidate `other` at an end of its shapes: there both explain the same. If one of them gains
/// less, its own fit may have ended in a worse minimum: it is fitted once more from where the fit of the better one has
/// ended. Returns the index of that candidate if it has a better fit then.
std::optional<std::size_t> fit_from_the_better(std::size_t one, std::size_t other, const Field& field) {
  const auto& [evidence, basis, without, trials, fits] = field;
  const Refitter& refitter = basis.refitter;
  if (fits[other].usable && trials[other].can_be_named() && trials[other].gain > trials[one].gain) {
    const Hypothesis& h = fits[other].hypothesis;
    const std::size_t place = place_of(trials[other].effect, h);
    const auto end = at_the_end_that_is(h.effects[place], trials[one].effect, refitter.nominal());
    if (end && refit_from(refitter.with_effect(without_effect(h, place), *end), evidence.score(h), one, field))
      return one;
  } else if (fits[one].usable && trials[one].is_another && trials[one].gain > trials[other].gain) {
    const Hypothesis& h = fits[one].hypothesis;
    const std::size_t place = place_of(trials[one].effect, h);
    if (refit_from(with_the_other_effect(refitter, h, place), evidence.score(h), other, field)) return other;
  }
  return {};
}

}  // namespace

std::vector<PlacedEffect> candidates_beside(const Evidence& evidence, const Hypothesis& h,
                                            const ArmParameters<double>& arm) {
  std::vector<PlacedEffect> all = all_candidates(arm);
  std::erase_if(all, [&](const PlacedEffect& candidate) {
    if (!has_enough_periods(evidence, candidate, arm)) return true;
    return !may_repeat(candidate, arm) &&
           std::ranges::any_of(h.effects, [&](const PlacedEffect& e) { return same_name(e, candidate); });
  });
  return all;
}

RoundOutcome compete(const Evidence& evidence, const Basis& basis, double significance, CandidateRound& round,
                     const Scored& without, const std::vector<PlacedEffect>& candidates,
                     const std::optional<Standing>& standing) {
  RoundOutcome outcome;
  std::vector<Trial>& trials = outcome.told.trials;
  trials = round.look(candidates);
  std::optional<Trial> its;
  if (standing) {
    its = trial_of(evidence, basis, *standing, without);
    round.keep_rivals_of(*its, standing->found.fit.hypothesis, trials);
  }
  std::vector<Fit> fits = round.fit_leaders(trials);
  std::optional<std::size_t> kept;
  if (its) kept = keep_standing(evidence, basis.judge, standing->found, *its, trials, fits);
  std::vector<bool> has_better_fit(trials.size(), false);
  for (std::size_t i = 0; i < trials.size(); ++i)
    for (std::size_t j = 0; j < trials.size(); ++j) {
      const bool is_fitted = fits[i].usable || fits[j].usable;
      if (!is_fitted || !becomes(trials[i].effect, trials[j].effect, basis.model.nominal)) continue;
      const auto better = fit_from_the_better(i, j, {evidence, basis, without, trials, fits});
      if (better) has_better_fit[*better] = true;
    }
  const std::vector<bool> is_convincing = convincing(trials, significance);
  std::vector<std::size_t> able;
  for (std::size_t i = 0; i < fits.size(); ++i)
    if (is_convincing[i] && fits[i].usable) able.push_back(i);
  const Competition competition(evidence, basis.model, basis.judge, without, trials);
  if (able.empty()) {
    outcome.no_effect = competition.weight_of_no_effect();
    return outcome;
  }
  const Competition::Choice choice = competition.choose(able);
  outcome.won = {fits[choice.named], competition.naming(choice), trials[choice.named].effect,
                 choice.named == kept && !has_better_fit[choice.named]};
  outcome.told.accepted = true;
  const auto named = trials.begin() + static_cast<std::ptrdiff_t>(choice.named);
  std::rotate(trials.begin(), named, named + 1);
  return outcome;
}

}  // namespace halyard

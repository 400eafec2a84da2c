#include "diagnosis/search/compete.h"

#include <algorithm>

#include "diagnosis/round/essence.h"

namespace halyard {
namespace {

bool may_repeat(const PlacedEffect& e, const ArmParameters<double>& arm) {
  return has_instants(e, arm) || search_space(*e.effect, arm, e.joint).order_of_motor_torque;
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
    const Found anew{fit, evidence.score(fit.hypothesis)};
    if (judge.cost(anew.scored()) + kRule.worth_a_change <= judge.cost(found.scored())) return {};
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

/// Fits `rival` once more, from where it is what `better` is and from the numbers which that has found. The better fit
/// stays.
void fit_at_its_end(std::size_t rival, std::size_t better, const Field& field) {
  const auto& [evidence, basis, without, trials, fits] = field;
  const Hypothesis& from = fits[better].hypothesis;
  const auto its = std::ranges::find_if(
      from.effects, [&, &name = trials[better].effect](const PlacedEffect& e) { return same_name(e, name); });
  const auto place = static_cast<std::size_t>(its - from.effects.begin());
  const PlacedEffect end = at_the_end_that_is(*its, trials[rival].effect, basis.model.nominal);
  const Found found =
      basis.refitted(basis.refitter.with_effect(without_effect(from, place), end), evidence.score(from));
  if (!found.fit.usable || !found.score.finite) return;
  if (fits[rival].usable) {
    const Scored present{fits[rival].hypothesis, evidence.score(fits[rival].hypothesis)};
    if (basis.judge.cost(found.scored()) + kRule.worth_a_change > basis.judge.cost(present)) return;
  }
  trials[rival] = trial_of(evidence, basis, {found, found.fit.hypothesis.effects.size() - 1}, without);
  fits[rival] = found.fit;
}

/// A candidate that is another one at an end of its shapes explains there what that other one explains. If it gains
/// less, its own fit has ended in a worse minimum.
void fit_rivals_at_their_ends(const Field& field) {
  for (std::size_t i = 0; i < field.trials.size(); ++i)
    for (std::size_t j = 0; j < field.trials.size(); ++j)
      if (field.fits[j].usable && field.trials[j].can_be_named() && field.trials[j].gain > field.trials[i].gain &&
          becomes(field.trials[i].effect, field.trials[j].effect, field.basis.model.nominal))
        fit_at_its_end(i, j, field);
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
  fit_rivals_at_their_ends({evidence, basis, without, trials, fits});
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
  outcome.won = {fits[choice.named], competition.naming(choice), trials[choice.named].effect, choice.named == kept};
  outcome.told.accepted = true;
  const auto named = trials.begin() + static_cast<std::ptrdiff_t>(choice.named);
  std::rotate(trials.begin(), named, named + 1);
  return outcome;
}

}  // namespace halyard

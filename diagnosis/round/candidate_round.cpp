#include "diagnosis/round/candidate_round.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "diagnosis/prediction/side_by_side.h"
#include "diagnosis/round/essence.h"

namespace halyard {

std::vector<std::size_t> leaders_of(const std::vector<Prospect>& prospects, double share) {
  const auto gain = [&](std::size_t i) { return prospects[i].gain; };
  const auto left = [&](std::size_t i) { return prospects[i].left; };
  std::vector<std::size_t> leaders, usable;
  for (std::size_t i = 0; i < prospects.size(); ++i) {
    if (prospects[i].is_judged) leaders.push_back(i);
    if (std::isfinite(left(i))) usable.push_back(i);
  }
  std::ranges::stable_sort(leaders, std::ranges::greater{}, gain);
  if (leaders.size() > kRule.leaders) leaders.resize(kRule.leaders);
  const double worth = leaders.empty() ? 0 : share * gain(leaders[0]);
  std::erase_if(leaders, [&](std::size_t i) { return gain(i) <= worth; });
  std::ranges::stable_sort(usable, {}, left);
  if (usable.size() > kRule.leaders_by_rest) usable.resize(kRule.leaders_by_rest);
  for (const std::size_t i : usable)
    if (std::ranges::find(leaders, i) == leaders.end()) leaders.push_back(i);
  return leaders;
}

bool is_rival(const Prospect& candidate, double shared, const Prospect& standing, double left_without) {
  if (candidate.gain > 0 && shared < kRule.shared_gain) return false;
  return candidate.gain >= kRule.rivals * standing.gain || candidate.left <= (standing.left + left_without) / 2;
}

CandidateRound::CandidateRound(const Evidence& evidence, const ArmModel& model, const Refitter& refitter,
                               const Judge& judge, Scored without, Hypothesis from, const std::string& name,
                               const SearchProgress& progress)
    : evidence_(evidence),
      model_(model),
      refitter_(refitter),
      judge_(judge),
      without_(std::move(without)),
      linear_{std::move(from), {}, {}, {}},
      coarse_(evidence.coarse_around(linear_.from)),
      scale_(channel_scale(evidence, without_.score.fit_mean_square)),
      name_(name),
      progress_(progress) {
  for (const FitParameter& p : refitter_.parameters(linear_.from)) {
    if (!p.effect) linear_.numbers.push_back(p);
    else if (!p.is_whole) found_.push_back(p);
  }
  linear_.columns = sensitivities(evidence_, linear_.from, linear_.numbers);
  found_columns_ = sensitivities(evidence_, linear_.from, found_);
}

void CandidateRound::each(const std::string& what, std::size_t n, const std::function<void(std::size_t)>& one) const {
  std::mutex one_at_a_time;
  std::size_t done = 0;
  progress_(what + " of " + name_, 0);
  run_side_by_side(n, [&](std::size_t i) {
    one(i);
    const std::lock_guard lock(one_at_a_time);
    progress_(what + " of " + name_, static_cast<double>(++done) / static_cast<double>(n));
  });
}

/// All channels weigh alike in a promise: what one of many channels shows is a small share of all.
double CandidateRound::least_promise() const {
  double channels = 0;
  for (int c = 0; c < evidence_.channels(); ++c) channels += evidence_.has_channel(c);
  return std::min(kRule.promise, kRule.promise_of_channel / channels);
}

std::vector<Trial> CandidateRound::look(const std::vector<PlacedEffect>& candidates) {
  if (linear_.columns.size() < linear_.numbers.size() || found_columns_.size() < found_.size()) return {};
  screen_.emplace(quick(), linear_.from, linear_.columns, scale_);
  linear_.starts.assign(candidates.size(), {});
  each("candidates", candidates.size(), [&](std::size_t i) {
    linear_.starts[i] =
        best_start(quick(), *screen_, refitter_.with_effect(linear_.from, candidates[i]), model_.nominal);
  });
  std::vector<std::size_t> fitted;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (linear_.starts[i].promise >= least_promise()) fitted.push_back(i);
  std::ranges::stable_sort(fitted, {}, [&](std::size_t i) { return linear_.starts[i].left; });
  if (fitted.size() > kRule.most_fitted) fitted.resize(kRule.most_fitted);

  std::vector<Look> looks;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Trial& t = looks.emplace_back(Look{unusable(candidates[i]), {}}).trial;
    t.promising = linear_.starts[i].promise >= least_promise();
    t.is_fitted = false;
  }
  quick_fits(fitted, looks);
  std::ranges::stable_sort(looks, std::ranges::greater{}, [](const Look& l) { return l.trial.gain; });
  std::vector<Trial> trials;
  prospects_.clear();
  ends_.clear();
  for (Look& l : looks) {
    prospects_.push_back({l.trial.is_judged(), l.trial.gain, l.left});
    trials.push_back(std::move(l.trial));
    ends_.push_back(std::move(l.ends));
  }
  leaders_ = leaders_of(prospects_, kRule.leads);
  return trials;
}

void CandidateRound::quick_fits(const std::vector<std::size_t>& candidates, std::vector<Look>& looks) const {
  struct FromStart {
    std::size_t candidate;
    const Hypothesis* start;
    Scored end = {};
    double cost = std::numeric_limits<double>::infinity();
  };
  std::vector<FromStart> all;
  for (const std::size_t i : candidates)
    for (const Hypothesis& start : linear_.starts[i].hypotheses) all.push_back({i, &start});
  each("fits", all.size(), [&](std::size_t a) {
    const Fit fit = quick_fit(*all[a].start);
    if (!fit.usable) return;
    all[a].end = {fit.hypothesis, quick().score(fit.hypothesis)};
    if (all[a].end.score.finite) all[a].cost = judge_.cost(all[a].end);
  });
  std::ranges::stable_sort(all, {}, &FromStart::cost);
  for (const FromStart& a : all) {
    std::vector<Hypothesis>& ends = looks[a.candidate].ends;
    const auto is_there = [&](const Hypothesis& end) { return is_same_end(end, a.end.hypothesis); };
    if (std::isfinite(a.cost) && std::ranges::none_of(ends, is_there)) ends.push_back(a.end.hypothesis);
  }
  run_side_by_side(candidates.size(), [&](std::size_t c) {
    Look& look = looks[candidates[c]];
    if (!look.ends.empty()) {
      look.trial = judge_.trial(look.ends[0], without_, look.ends[0].effects.size() - 1);
      for (const auto& rows : quick().fit_rows(look.ends)) look.left = std::min(look.left, screen_->left(rows));
    }
    look.trial.is_fitted = true;
  });
}

/// True if two quick fits have ended in the same minimum; the past is not compared.
bool CandidateRound::is_same_end(const Hypothesis& a, const Hypothesis& b) const {
  constexpr double kNear = 0.01;
  return std::ranges::all_of(
      effect_parameters(quick(), a, model_.nominal, a.effects.size() - 1), [&](const FitParameter& p) {
        const double x = parameter_value(a, p), y = parameter_value(b, p);
        return p.is_past || std::abs(x - y) <= kNear * std::max(p.scale, std::abs(x - p.nominal));
      });
}

Fit CandidateRound::quick_fit(const Hypothesis& start) const {
  const PlacedEffect& effect = start.effects.back();
  std::vector<FitParameter> parameters;
  std::vector<std::vector<double>> linear;
  for (std::size_t i = 0; i < linear_.numbers.size(); ++i) {
    if (effect_covers(effect, model_.nominal, linear_.numbers[i])) continue;
    parameters.push_back(linear_.numbers[i]);
    linear.push_back(linear_.columns[i]);
  }
  parameters.insert(parameters.end(), found_.begin(), found_.end());
  linear.insert(linear.end(), found_columns_.begin(), found_columns_.end());
  const std::size_t own = start.effects.size() - 1;
  for (const FitParameter& p : refitter_.parameters(start))
    if (p.effect == own) parameters.push_back(p);
  FitOptions options;
  options.iterations = 20;
  options.cost_tolerance = 3e-4;
  return fit(quick(), start, parameters, scale_, options, linear);
}

Refit CandidateRound::refit_from(const Hypothesis& end) const {
  const std::size_t last = end.effects.size() - 1;
  const std::vector<double> past = last < end.past.size() ? end.past[last] : std::vector<double>();
  Refit r{refitter_.with_effect(linear_.from, end.effects[last], past), without_.score};
  r.nudged_from = linear_.from.effects.size();
  r.is_nudged = false;  // not before one of the ends is chosen
  return r;
}

/// Beside another effect that is still missing, a part of a right effect may end at its bound to explain that one. If
/// the rest of it can be named, this is what the candidate is.
void CandidateRound::give_up_bounds(Refit& refit, Trial& trial) const {
  const std::size_t place = refit.best.hypothesis.effects.size() - 1;
  std::vector<FitParameter> held = refit.held;
  const auto start = judge_.without_sizes_at_bound(refit.best.hypothesis, place, held);
  if (!start) return;
  Refit reduced = restarted(refit, *start);
  reduced.held = std::move(held);
  refitter_.go_on(reduced, 1);
  if (!reduced.best.usable) return;
  const Trial rest = judge_.trial(reduced.best.hypothesis, without_, place);
  if (!rest.can_be_named()) return;
  refit = std::move(reduced);
  trial = rest;
}

void CandidateRound::keep_rivals_of(const Trial& standing, const Hypothesis& with, const std::vector<Trial>& trials) {
  if (trials.empty()) return;
  const Likelihood none = log_likelihood(evidence_, without_.score, squared_floors(evidence_));
  const Prospect its{true, standing.gain, left_at(with)};
  const double left_without = left_at(without_.hypothesis);
  std::vector<Prospect> rivals = prospects_;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const Trial& t = trials[i];
    const double shared = t.usable ? shared_gain(t.log_likelihood, standing.log_likelihood, none) : 0;
    const bool competes =
        same_name(t.effect, standing.effect) ? t.gain > standing.gain : is_rival(rivals[i], shared, its, left_without);
    if (!competes) rivals[i] = {};
  }
  leaders_ = leaders_of(rivals, kRule.leads);
}

std::vector<Fit> CandidateRound::fit_leaders(std::vector<Trial>& trials) const {
  std::vector<std::pair<std::size_t, Refit>> first;
  for (const std::size_t i : leaders_)
    for (const Hypothesis& end : ends_[i]) first.emplace_back(i, refit_from(end));
  each("starts of the best candidates", first.size(), [&](std::size_t f) { refitter_.go_on(first[f].second, 1); });
  std::vector<Refit> refits(trials.size());
  for (auto& [i, refit] : first)
    if (!refits[i].best.usable || refit.last < refits[i].last) refits[i] = std::move(refit);
  for (Refit& r : refits) r.is_nudged = true;
  const auto judge = [&](std::size_t i) {
    const Hypothesis& h = refits[i].best.hypothesis;
    trials[i] = refits[i].best.usable ? judge_.trial(h, without_, h.effects.size() - 1) : unusable(trials[i].effect);
    if (trials[i].at_bound) give_up_bounds(refits[i], trials[i]);
    if (!trials[i].can_be_named()) return;
    const Hypothesis& named = refits[i].best.hypothesis;
    trials[i].is_another =
        is_another_effect(evidence_, refitter_, judge_, restarted(refits[i], named), named.effects.size() - 1);
  };
  const auto go_on_with = [&](const std::string& what, const std::vector<std::size_t>& going, int passes) {
    each(what, going.size(), [&](std::size_t g) {
      refitter_.go_on(refits[going[g]], passes);
      judge(going[g]);
    });
  };
  // After one pass the right candidate may still be far from its minimum.
  go_on_with("best candidates", leaders_, kRule.first_passes - 1);
  std::vector<Prospect> prospects(trials.size());
  run_side_by_side(leaders_.size(), [&](std::size_t l) {
    const std::size_t i = leaders_[l];
    if (trials[i].is_judged()) prospects[i] = {true, trials[i].gain, left_at(refits[i].best.hypothesis)};
  });
  std::vector<std::size_t> finalists = leaders_of(prospects, kRule.still_leads);
  std::erase_if(finalists, [&](std::size_t i) { return refits[i].settled; });
  go_on_with("finalists", finalists, kRule.most_passes - kRule.first_passes);
  std::vector<Fit> fits;
  for (const Refit& r : refits) fits.push_back(r.best);
  return fits;
}

}  // namespace halyard

#include "diagnosis/search/candidate_round.h"

#include <algorithm>
#include <mutex>

#include "diagnosis/prediction/side_by_side.h"

namespace halyard {

CandidateRound::CandidateRound(const Evidence& evidence, const ArmModel& model, const Refitter& refitter,
                               const Judge& judge, Scored without, Hypothesis from, const std::string& name,
                               const SearchProgress& progress)
    : evidence_(evidence),
      model_(model),
      refitter_(refitter),
      judge_(judge),
      without_(std::move(without)),
      linear_{std::move(from), {}, {}, {}},
      scale_(channel_scale(evidence, without_.score.fit_mean_square)),
      name_(name),
      progress_(progress) {
  for (const FitParameter& p : refitter_.parameters(linear_.from)) {
    if (p.effect < 0) linear_.numbers.push_back(p);
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

std::vector<Trial> CandidateRound::look(const std::vector<PlacedEffect>& candidates) {
  if (linear_.columns.size() < linear_.numbers.size() || found_columns_.size() < found_.size()) return {};
  const Screen screen(evidence_, linear_.from, linear_.columns, scale_);
  linear_.starts.assign(candidates.size(), {});
  each("candidates", candidates.size(), [&](std::size_t i) {
    linear_.starts[i] =
        best_start(evidence_, screen, refitter_.with_effect(linear_.from, candidates[i]), model_.nominal);
  });
  std::vector<std::size_t> fitted;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (linear_.starts[i].promise >= kRule.promise) fitted.push_back(i);
  std::ranges::stable_sort(fitted, {}, [&](std::size_t i) { return linear_.starts[i].left; });
  if (fitted.size() > kRule.most_fitted) fitted.resize(kRule.most_fitted);

  std::vector<Trial> trials;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    trials.push_back(unusable(candidates[i]));
    trials.back().promising = linear_.starts[i].promise >= kRule.promise;
    trials.back().is_fitted = false;
  }
  each("fits", fitted.size(), [&](std::size_t f) {
    const std::size_t i = fitted[f];
    trials[i] = quick_look(linear_.starts[i].hypothesis, candidates[i]);
  });
  std::ranges::stable_sort(trials, std::ranges::greater{}, &Trial::gain);
  return trials;
}

Trial CandidateRound::quick_look(const Hypothesis& start, const PlacedEffect& effect) const {
  std::vector<FitParameter> parameters;
  std::vector<std::vector<double>> linear;
  for (std::size_t i = 0; i < linear_.numbers.size(); ++i) {
    if (effect_covers(effect, model_.nominal, linear_.numbers[i])) continue;
    parameters.push_back(linear_.numbers[i]);
    linear.push_back(linear_.columns[i]);
  }
  parameters.insert(parameters.end(), found_.begin(), found_.end());
  linear.insert(linear.end(), found_columns_.begin(), found_columns_.end());
  const int own = static_cast<int>(start.effects.size()) - 1;
  for (const FitParameter& p : refitter_.parameters(start))
    if (p.effect == own) parameters.push_back(p);
  FitOptions options;
  options.iterations = 6;
  options.cost_tolerance = 3e-4;
  const Fit f = fit(evidence_, start, parameters, scale_, options, linear);
  return f.usable ? judge_.trial(f.hypothesis, without_, f.hypothesis.effects.size() - 1) : unusable(effect);
}

std::vector<Fit> CandidateRound::fit_leaders(std::vector<Trial>& trials) const {
  std::vector<Refit> refits;
  for (std::size_t i = 0; i < std::min(kRule.leaders, trials.size()); ++i)
    refits.push_back({refitter_.with_effect(linear_.from, trials[i].effect, trials[i].past), without_.score});
  const auto go_on_with = [&](const std::string& what, double share, int passes) {
    double best = 0;
    for (std::size_t i = 0; i < refits.size(); ++i) best = std::max(best, trials[i].gain);
    each(what, refits.size(), [&](std::size_t i) {
      Trial& t = trials[i];
      if (!t.is_judged() || !(t.gain > share * best) || refits[i].settled) return;
      refitter_.go_on(refits[i], passes);
      const Hypothesis& h = refits[i].best.hypothesis;
      t = refits[i].best.usable ? judge_.trial(h, without_, h.effects.size() - 1) : unusable(t.effect);
    });
  };
  go_on_with("best candidates", kRule.leads, kRule.first_passes);
  go_on_with("finalists", kRule.still_leads, kRule.most_passes - kRule.first_passes);
  std::vector<Fit> fits;
  for (const Refit& r : refits) fits.push_back(r.best);
  return fits;
}

}  // namespace halyard

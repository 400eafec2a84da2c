#include "diagnosis/attribution.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include "diagnosis/false_discovery.h"
#include "diagnosis/starts.h"
#include "model/input_error.h"

namespace halyard {
namespace {

/// A candidate that promises less than this share of the residual, to first order, is not fitted at all.
constexpr double kPromise = 0.02;
/// So many of those that were fitted are fitted whole: the best, if they gain this share of what the first of them does.
constexpr std::size_t kLeaders = 4;
constexpr double kLeads = 0.25;
/// After so many passes those go on, to this many in all, that gain so much of what the first of them does by then.
constexpr int kFirstPasses = 3, kMostPasses = 12;
constexpr double kStillLeads = 0.5;

class Search {
 public:
  Search(const Evidence& evidence, const ArmModel& model, const AttributionOptions& options,
         const std::function<void(const std::string&, double)>& progress)
      : evidence_(evidence), model_(model), options_(options), progress_(progress), given_(model.effects.size()) {}

  Attribution run() {
    const Hypothesis nominal{model_.nominal, model_.effects};
    say("nominal model", 0);
    result_.nominal_score = evidence_.score(nominal);
    if (result_.nominal_score.finite && keep_sensitive_numbers(nominal))
      result_.baseline = refit(nominal, result_.nominal_score);
    if (!result_.baseline.usable)
      throw InputError(model_.source +
                       ": cannot be integrated along the measured motion; expected frictions and cables that settle "
                       "more slowly: take larger smoothing speeds, or less damping");
    result_.baseline_score = evidence_.score(result_.baseline.hypothesis);
    judge_.emplace(evidence_, model_, numbers_, result_.baseline_score.mean_square);

    Found current{result_.baseline, result_.baseline_score};
    for (int round = 0; round < options_.most_effects; ++round)
      if (!add_one(current)) break;
    remove_idle(current);

    result_.final_fit = current.fit;
    result_.final_score = current.score;
    return std::move(result_);
  }

 private:
  struct Found {
    Fit fit;
    Score score;
    Scored scored() const { return {fit.hypothesis, score}; }
  };

  /// What all candidates of a round start from.
  struct Ground {
    Scored without;                            ///< what they are judged against
    Hypothesis from;                           ///< where their fits set out
    std::vector<FitParameter> numbers;         ///< baseline numbers that no effect so far speaks for
    std::vector<std::vector<double>> columns;  ///< sensitivities to them
    std::vector<double> scale;                 ///< [2n] of the residual
    std::string round;
  };

  void say(const std::string& what, double fraction) const {
    if (progress_) progress_(what, fraction);
  }

  /// Calls one(i) for all i < n, side by side.
  template <class One>
  void each(const std::string& what, std::size_t n, const One& one) const {
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
      one(i);
      say(what, static_cast<double>(++done) / static_cast<double>(n));
    });
  }

  /// A number whose whole tolerance moves no channel by a tenth of its floor cannot be learnt from these data. False if
  /// one cannot be told.
  bool keep_sensitive_numbers(const Hypothesis& nominal) {
    const std::vector<FitParameter> all = baseline_parameters(model_);
    const auto columns = sensitivities(evidence_, nominal, all);
    if (columns.size() < all.size()) return false;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      std::vector<double> change = columns[i];
      for (double& x : change) x = x * (all[i].upper - all[i].nominal) / all[i].scale;
      if (evidence_.exceeds_floor(change, 0.1)) numbers_.push_back(all[i]);
    }
    return true;
  }

  /// Baseline numbers that no effect of the hypothesis speaks for, the past of its effects, and the parameters of the
  /// added ones.
  std::vector<FitParameter> all_parameters(const Hypothesis& h) const {
    std::vector<FitParameter> all;
    for (const FitParameter& b : numbers_) {
      bool covered = false;
      for (std::size_t e = given_; e < h.effects.size(); ++e)
        covered = covered || effect_covers(h.effects[e], model_.nominal, b);
      if (!covered) all.push_back(b);
    }
    for (std::size_t e = 0; e < h.effects.size(); ++e)
      for (const FitParameter& p : effect_parameters(evidence_, h, model_.nominal, static_cast<int>(e)))
        if (e >= given_ || is_past(p)) all.push_back(p);
    return all;
  }

  /// A number that an effect speaks for goes back to the model's value.
  Hypothesis with_effect(Hypothesis h, const PlacedEffect& effect, const std::vector<double>& past = {}) const {
    h.effects.push_back(effect);
    for (std::size_t i = 0; i < past.size(); ++i) h.set_past_state(h.effects.size() - 1, i, past[i]);
    for (const FitParameter& b : baseline_parameters(model_))
      if (effect_covers(effect, model_.nominal, b)) set_parameter(h, b, b.nominal);
    return h;
  }

  /// A fit of all numbers under way.
  struct Refit {
    Hypothesis at;
    Score score;  ///< there; before the first pass of whatever the first weights are to come from
    Fit best = {};
    double last = std::numeric_limits<double>::infinity();  ///< Σ ln of the mean squares after the last pass
    bool settled = false;
  };

  /// Passes until it no longer helps, at most so many: each weighs the channels by what the last one left.
  void go_on(Refit& r, int passes) const {
    constexpr double kWorthAPass = 0.02;
    for (; passes > 0 && !r.settled; --passes) {
      r.settled = true;
      const std::vector<double> scale = channel_scale(evidence_, r.score.fit_mean_square);
      r.at = nudged(evidence_, r.at, given_, model_.nominal, scale);
      const std::vector<FitParameter> parameters = all_parameters(r.at);
      std::vector<FitParameter> numbers;
      for (const FitParameter& p : parameters)
        if (p.effect < 0) numbers.push_back(p);
      const auto columns = sensitivities(evidence_, r.at, numbers);
      if (columns.empty() && !numbers.empty()) return;
      FitOptions options;
      options.frozen_baseline = true;
      const Fit f = fit(evidence_, r.at, parameters, scale, options, columns);
      if (!f.usable) return;
      r.score = evidence_.score(f.hypothesis);
      if (!r.score.finite) return;
      double now = 0;
      for (int c = 0; c < evidence_.channels(); ++c)
        if (evidence_.has_channel(c))
          now += std::log(r.score.fit_mean_square[c] + evidence_.floor()[c] * evidence_.floor()[c]);
      if (now < r.last) r.best = f;
      r.at = f.hypothesis;
      r.settled = now > r.last - kWorthAPass;
      r.last = now;
    }
  }

  Fit refit(const Hypothesis& h, const Score& before) const {
    Refit r{h, before};
    go_on(r, kMostPasses);
    return r.best;
  }

  /// Fits again from the model's own numbers, which on the way were bent by what was missing; keeps the better fit.
  void fit_afresh(Found& current) const {
    const Hypothesis& h = current.fit.hypothesis;
    Found afresh{refit({model_.nominal, h.effects, h.past}, current.score), {}};
    if (!afresh.fit.usable) return;
    afresh.score = evidence_.score(afresh.fit.hypothesis);
    if (afresh.score.finite && judge_->cost(afresh.scored()) < judge_->cost(current.scored()))
      current = std::move(afresh);
  }

  std::vector<PlacedEffect> candidates(const Hypothesis& h) const {
    std::vector<PlacedEffect> all = all_candidates(model_.nominal);
    std::erase_if(all, [&](const PlacedEffect& candidate) {
      return std::any_of(h.effects.begin(), h.effects.end(), [&](const PlacedEffect& e) {
        return e.effect == candidate.effect && e.joint == candidate.joint;
      });
    });
    return all;
  }

  /// Of each trial. One that could not be named counts among the tests, and not among what they find.
  std::vector<bool> convincing(const std::vector<Trial>& trials) const {
    std::vector<double> p;
    for (const Trial& t : trials) {
      const bool nameable = t.is_judged() && t.gain > 0 && !t.at_bound && !t.is_refit && t.matters;
      if (t.is_fitted) p.push_back(nameable ? t.p_value : 1.0);
    }
    const std::vector<double> rate = false_discovery_rates(p);
    std::vector<bool> is(trials.size(), false);
    for (std::size_t i = 0, next = 0; i < trials.size(); ++i)
      if (trials[i].is_fitted) is[i] = rate[next++] < options_.significance;
    return is;
  }

  /// True if no channel has a residual left above its floor.
  bool explained(const Score& score) const {
    for (int c = 0; c < evidence_.channels(); ++c) {
      const double enough = std::pow(evidence_.floor()[c], 2);
      if (evidence_.has_channel(c) && (score.mean_square[c] > enough || score.fit_mean_square[c] > enough))
        return false;
    }
    return true;
  }

  /// One round: a quick look at every candidate, a full fit of the best, and the best of those.
  bool add_one(Found& current) {
    if (explained(current.score)) return false;
    Ground ground{current.scored(), current.fit.hypothesis, {}, {}, {}, {}};
    ground.round = " of round " + std::to_string(result_.rounds.size() + 1);
    ground.scale = channel_scale(evidence_, current.score.fit_mean_square);
    // Before any effect is named the baseline's refit is bent by what is missing: the look starts at the model's
    // numbers.
    if (result_.rounds.empty()) ground.from = {model_.nominal, model_.effects, current.fit.hypothesis.past};
    for (const FitParameter& p : all_parameters(ground.from))
      if (p.effect < 0) ground.numbers.push_back(p);
    ground.columns = sensitivities(evidence_, ground.from, ground.numbers);
    if (ground.columns.empty() && !ground.numbers.empty()) return false;

    Round round;
    round.trials = look(ground, candidates(current.fit.hypothesis));
    const std::vector<Fit> fits = fit_leaders(ground, round.trials);
    const std::vector<bool> convincing = this->convincing(round.trials);
    std::vector<std::size_t> able;
    for (std::size_t i = 0; i < fits.size(); ++i)
      if (convincing[i] && fits[i].usable) able.push_back(i);
    if (!able.empty()) {
      const std::size_t named = choose(ground.without, round.trials, able);
      current.fit = fits[named];
      current.score = evidence_.score(current.fit.hypothesis);
      if (!result_.rounds.empty()) fit_afresh(current);
      round.accepted = true;
      std::swap(round.trials[0], round.trials[named]);
    }
    result_.rounds.push_back(std::move(round));
    return !able.empty();
  }

  /// A trial of each candidate, the best first.
  std::vector<Trial> look(const Ground& ground, const std::vector<PlacedEffect>& all) const {
    const Screen screen(evidence_, ground.from, ground.columns, ground.scale);
    std::vector<Start> starts(all.size());
    each("candidates" + ground.round, all.size(), [&](std::size_t i) {
      starts[i] = best_start(evidence_, screen, with_effect(ground.from, all[i]), model_.nominal);
    });
    std::vector<std::size_t> fitted;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (starts[i].promise >= kPromise) fitted.push_back(i);
    std::ranges::stable_sort(fitted, {}, [&](std::size_t i) { return starts[i].left; });
    if (fitted.size() > kMostFitted) fitted.resize(kMostFitted);

    std::vector<Trial> trials;
    for (std::size_t i = 0; i < all.size(); ++i) {
      trials.push_back(unusable(all[i]));
      trials.back().promising = starts[i].promise >= kPromise;
      trials.back().is_fitted = false;
    }
    each("fits" + ground.round, fitted.size(), [&](std::size_t f) {
      const std::size_t i = fitted[f];
      trials[i] = quick_look(ground, starts[i].hypothesis, all[i]);
    });
    std::ranges::stable_sort(trials, std::ranges::greater{}, &Trial::gain);
    return trials;
  }

  Trial quick_look(const Ground& ground, const Hypothesis& start, const PlacedEffect& effect) const {
    std::vector<FitParameter> parameters;
    std::vector<std::vector<double>> kept;
    for (std::size_t i = 0; i < ground.numbers.size(); ++i) {
      if (effect_covers(effect, model_.nominal, ground.numbers[i])) continue;
      parameters.push_back(ground.numbers[i]);
      kept.push_back(ground.columns[i]);
    }
    for (const FitParameter& p : all_parameters(start))
      if (p.effect >= 0) parameters.push_back(p);
    FitOptions options;
    options.iterations = 6;
    options.cost_tolerance = 3e-4;
    options.frozen_baseline = true;
    const Fit f = fit(evidence_, start, parameters, ground.scale, options, kept);
    return f.usable ? judge_->trial(f.hypothesis, ground.without, effect) : unusable(effect);
  }

  /// The quick look takes the baseline's sensitivities once; for the leaders they are renewed until nothing changes.
  /// Returns their fits, in the order of the trials, which are judged anew.
  std::vector<Fit> fit_leaders(const Ground& ground, std::vector<Trial>& trials) const {
    std::vector<Refit> refits;
    for (std::size_t i = 0; i < std::min(kLeaders, trials.size()); ++i)
      refits.push_back({with_effect(ground.from, trials[i].effect, trials[i].past), ground.without.score});
    const auto go_on_with = [&](const std::string& what, double share, int passes) {
      double best = 0;
      for (std::size_t i = 0; i < refits.size(); ++i) best = std::max(best, trials[i].gain);
      each(what + ground.round, refits.size(), [&](std::size_t i) {
        Trial& t = trials[i];
        if (!t.is_judged() || !(t.gain > share * best) || refits[i].settled) return;
        go_on(refits[i], passes);
        const PlacedEffect effect = t.effect;
        t = refits[i].best.usable ? judge_->trial(refits[i].best.hypothesis, ground.without, effect) : unusable(effect);
      });
    };
    go_on_with("best candidates", kLeads, kFirstPasses);
    go_on_with("finalists", kStillLeads, kMostPasses - kFirstPasses);
    std::vector<Fit> fits;
    for (const Refit& r : refits) fits.push_back(r.best);
    return fits;
  }

  /// Which of the convincing leaders is named; the others that cannot be told from the best become its alternatives.
  std::size_t choose(const Scored& without, const std::vector<Trial>& trials, const std::vector<std::size_t>& able) {
    const std::size_t best = *std::ranges::max_element(able, {}, [&](std::size_t i) { return trials[i].gain; });
    const Likelihood ln_without = log_likelihood(evidence_, without.score, squared_floors(evidence_));
    std::vector<std::size_t> alike = {best};
    for (const std::size_t i : able) {
      if (i == best) continue;
      const Paired p = paired(evidence_, trials[best].log_likelihood, trials[i].log_likelihood);
      if (shared_gain(trials[best].log_likelihood, trials[i].log_likelihood, ln_without) < kSharedGain) continue;
      if (p.t < kTellApart || p.sum < 2 * kTellApart * kTellApart) alike.push_back(i);
    }
    // Of those that cannot be told apart the best is named; of those that are as good one that only changes the
    // model's own numbers, and then the one with the fewest numbers of its own.
    const auto simplicity = [&](std::size_t i) {
      const PlacedEffect& e = trials[i].effect;
      return std::pair(e.effect->stages() != 0, e.effect->parameters(model_.nominal, e.joint).size());
    };
    std::vector<std::size_t> as_good = alike;
    std::erase_if(as_good, [&](std::size_t i) { return trials[i].gain < trials[best].gain - kByChance; });
    const std::size_t named = *std::ranges::min_element(as_good, {}, simplicity);
    std::vector<PlacedEffect> like;
    for (const std::size_t i : alike)
      if (i != named) like.push_back(trials[i].effect);
    result_.alternatives.push_back(like);
    return named;
  }

  /// Each effect is tried for removal: one that a later one made idle goes.
  void remove_idle(Found& current) {
    while (current.fit.hypothesis.effects.size() > given_) {
      const std::size_t n = current.fit.hypothesis.effects.size() - given_;
      std::vector<Fit> without(n, result_.baseline);
      if (n > 1)
        tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
          without[i] = refit(without_effect(current.fit.hypothesis, given_ + i), current.score);
        });
      std::size_t gone = n;
      Found left;
      for (std::size_t i = 0; i < n && gone == n; ++i) {
        if (!without[i].usable) continue;
        left = {without[i], evidence_.score(without[i].hypothesis)};
        const int place = static_cast<int>(given_ + i);
        if (left.score.finite && !judge_->is_needed(current.scored(), left.scored(), place, options_.significance))
          gone = i;
      }
      if (gone == n) break;
      current = std::move(left);
      result_.alternatives.erase(result_.alternatives.begin() + gone);
    }
  }

  const Evidence& evidence_;
  const ArmModel& model_;
  const AttributionOptions& options_;
  const std::function<void(const std::string&, double)>& progress_;
  std::size_t given_;                  ///< effects that the model came with
  std::vector<FitParameter> numbers_;  ///< baseline numbers that the data can tell something of
  std::optional<Judge> judge_;         ///< from the baseline's refit on
  Attribution result_;
};

}  // namespace

std::vector<PlacedEffect> all_candidates(const ArmParameters<double>& arm) {
  std::vector<PlacedEffect> all;
  for (const Effect* effect : effect_library()) {
    std::vector<EffectPlace> places = effect_places(*effect, arm);
    // Of a single joint "at all joints alike" says nothing more than "at joint 1".
    if (effect->scope() == EffectScope::either && arm.n == 1) std::erase(places, kWholeArm);
    for (const EffectPlace joint : places) all.push_back(place_effect(*effect, arm, joint));
  }
  return all;
}

Attribution attribute(const Evidence& evidence, const ArmModel& model, const AttributionOptions& options,
                      const std::function<void(const std::string&, double)>& progress) {
  return Search(evidence, model, options, progress).run();
}

}  // namespace halyard

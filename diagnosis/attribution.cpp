#include "diagnosis/attribution.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "diagnosis/paired_t.h"
#include "diagnosis/starts.h"
#include "model/input_error.h"

namespace halyard {
namespace {

/// What is left matters above this many times the floor of its channel: about one resolution of a joint's encoder.
constexpr double kRestFactor = 3;
/// So little of a residual's root mean square is next to nothing.
constexpr double kNextToNone = 0.1;
/// What one number more gains in log-likelihood by chance: two standard deviations.
constexpr double kByChance = 2;
/// A candidate that promises less than this share of the residual, to first order, is not fitted at all.
constexpr double kPromise = 0.02;
/// So many candidates are fitted in a round: those that leave least of the residual where their search sets out.
constexpr std::size_t kMostFitted = 16;
/// A candidate whose quick look is less significant than this is not fitted whole.
constexpr double kWorthAFit = 0.05;

/// ln L of each deciding block and channel. least: [2n] mean squares that are added, below which residuals count alike.
Likelihood log_likelihood(const Evidence& evidence, const Score& score, const std::vector<double>& least) {
  const auto& count = evidence.block_count();
  Likelihood ln(count.size(), std::vector<double>(evidence.channels(), 0));
  for (std::size_t b = 0; b < count.size(); ++b)
    for (int c = 0; c < evidence.channels(); ++c)
      if (count[b][c] > 0)
        ln[b][c] =
            -0.5 * count[b][c] / evidence.correlated_rows() * std::log(score.block_sum[b][c] / count[b][c] + least[c]);
  return ln;
}

std::vector<double> floors(const Evidence& evidence) {
  std::vector<double> least;
  for (const double floor : evidence.floor()) least.push_back(floor * floor);
  return least;
}

/// For the significance of a gain: blocks that had next to no residual, a motor's rest say, neither carry nor spoil it.
std::vector<double> floors_beside(const Evidence& evidence, const Score& before) {
  std::vector<double> least = floors(evidence);
  for (std::size_t c = 0; c < least.size(); ++c) least[c] += kNextToNone * kNextToNone * before.mean_square[c];
  return least;
}

/// By how much one lies above the other in each deciding block that has rows.
Paired paired(const Likelihood& with, const Likelihood& without, const Evidence& evidence) {
  std::vector<double> differences;
  for (std::size_t b = 0; b < with.size(); ++b) {
    const auto total = [](const auto& all) { return std::reduce(all.begin(), all.end()); };
    if (total(evidence.block_count()[b]) > 0) differences.push_back(total(with[b]) - total(without[b]));
  }
  return halyard::paired(differences);
}

/// How much of what the lesser of two candidates gains, block by block and channel by channel, the other gains as well.
double shared_gain(const Likelihood& a, const Likelihood& b, const Likelihood& without) {
  double of_a = 0, of_b = 0, of_both = 0;
  for (std::size_t i = 0; i < without.size(); ++i)
    for (std::size_t c = 0; c < without[i].size(); ++c) {
      const double gain_a = std::max(0.0, a[i][c] - without[i][c]), gain_b = std::max(0.0, b[i][c] - without[i][c]);
      of_a += gain_a, of_b += gain_b, of_both += std::min(gain_a, gain_b);
    }
  return of_both / std::max(std::min(of_a, of_b), 1e-300);
}

Trial unusable(const PlacedEffect& effect) {
  Trial t;
  t.effect = effect;
  return t;
}

class Search {
 public:
  Search(const Evidence& evidence, const ArmModel& model, const AttributionOptions& options,
         const std::function<void(const std::string&, double)>& progress)
      : evidence_(evidence), model_(model), options_(options), progress_(progress) {}

  Attribution run() {
    const Hypothesis nominal{model_.nominal, model_.effects};
    given_ = nominal.effects.size();
    say("nominal model", 0);
    result_.nominal_score = evidence_.score(nominal);
    if (!result_.nominal_score.finite)
      throw InputError(model_.source +
                       ": cannot be integrated along the measured motion; expected frictions and cables that settle "
                       "more slowly: take larger smoothing speeds, or less damping");
    keep_sensitive_numbers(nominal);
    result_.baseline = refit(nominal, result_.nominal_score);
    result_.baseline_score = evidence_.score(result_.baseline.hypothesis);

    Fit current = result_.baseline;
    Score score = result_.baseline_score;
    for (int round = 0; round < options_.most_effects; ++round)
      if (!add_one(current, score)) break;
    remove_idle(current, score);

    result_.final_fit = current;
    result_.final_score = score;
    return std::move(result_);
  }

 private:
  void say(const std::string& what, double fraction) const {
    if (progress_) progress_(what, fraction);
  }

  /// A number whose whole tolerance moves no channel by a tenth of its floor cannot be learnt from these data.
  void keep_sensitive_numbers(const Hypothesis& nominal) {
    const std::vector<FitParameter> all = baseline_parameters(model_.nominal);
    const auto columns = sensitivities(evidence_, nominal, all);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      std::vector<double> change = columns[i];
      for (double& x : change) x = x * (all[i].upper - all[i].nominal) / all[i].scale;
      if (evidence_.exceeds_floor(change, 0.1)) numbers_.push_back(all[i]);
    }
  }

  /// Baseline numbers that no effect of the hypothesis speaks for, and the parameters of its added effects.
  std::vector<FitParameter> all_parameters(const Hypothesis& h) const {
    std::vector<FitParameter> all;
    for (const FitParameter& b : numbers_) {
      bool covered = false;
      for (std::size_t e = given_; e < h.effects.size(); ++e)
        covered = covered || effect_covers(h.effects[e], model_.nominal, b);
      if (!covered) all.push_back(b);
    }
    for (std::size_t e = given_; e < h.effects.size(); ++e)
      for (const FitParameter& p : effect_parameters(evidence_, h, model_.nominal, static_cast<int>(e)))
        all.push_back(p);
    return all;
  }

  /// A number that an effect speaks for goes back to the model's value.
  Hypothesis with_effect(Hypothesis h, const PlacedEffect& effect) const {
    h.effects.push_back(effect);
    for (const FitParameter& b : baseline_parameters(model_.nominal))
      if (effect_covers(effect, model_.nominal, b)) set_parameter(h, b, b.nominal);
    return h;
  }

  /// Fits all numbers until it no longer helps: each pass weighs the channels by what the last one left.
  Fit refit(const Hypothesis& h, const Score& before) const {
    constexpr int kMostPasses = 12;
    constexpr double kWorthAPass = 0.02;
    Fit best;
    Hypothesis at = h;
    Score score = before;
    double last = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < kMostPasses; ++pass) {
      const std::vector<double> scale = channel_scale(evidence_, score.fit_mean_square);
      at = nudged(evidence_, at, given_, model_.nominal, scale);
      const std::vector<FitParameter> parameters = all_parameters(at);
      std::vector<FitParameter> numbers;
      for (const FitParameter& p : parameters)
        if (p.effect < 0) numbers.push_back(p);
      const auto columns = sensitivities(evidence_, at, numbers);
      if (columns.empty() && !numbers.empty()) break;
      FitOptions options;
      options.frozen_baseline = true;
      const Fit f = fit(evidence_, at, parameters, scale, options, columns);
      if (!f.usable) break;
      score = evidence_.score(f.hypothesis);
      if (!score.finite) break;
      double now = 0;
      for (int c = 0; c < evidence_.channels(); ++c)
        if (evidence_.has_channel(c))
          now += std::log(score.fit_mean_square[c] + evidence_.floor()[c] * evidence_.floor()[c]);
      if (now < last) best = f;
      at = f.hypothesis;
      if (now > last - kWorthAPass) break;
      last = now;
    }
    return best;
  }

  /// What a fit weighs, of a score: -ln L on the fitting blocks and the stretch of the baseline's numbers.
  double cost(const Hypothesis& h, const Score& score) const {
    double sum = stretch(h);
    for (int c = 0; c < evidence_.channels(); ++c)
      if (evidence_.has_channel(c))
        sum += 0.5 * evidence_.fit_count(c) / evidence_.correlated_rows() *
               std::log(score.fit_mean_square[c] + evidence_.floor()[c] * evidence_.floor()[c]);
    return sum;
  }

  /// Fits again from the model's own numbers, which on the way were bent by what was missing; keeps the better fit.
  void fit_afresh(Fit& current, Score& score) const {
    const Fit f = refit({model_.nominal, current.hypothesis.effects}, score);
    if (!f.usable) return;
    const Score s = evidence_.score(f.hypothesis);
    if (!s.finite || cost(f.hypothesis, s) >= cost(current.hypothesis, score)) return;
    current = f;
    score = s;
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

  /// True if a number ends at its bound and does more there than one number by chance: a size alone, or with the shapes
  /// that follow it.
  bool at_bound(const Hypothesis& h, const Score& score, int place) const {
    const auto parameters = effect_parameters(evidence_, h, model_.nominal, place);
    const auto ends = [&](std::size_t i) { return ends_at_bound(parameters[i], parameter_value(h, parameters[i])); };
    const auto shape_ends = [&](std::size_t i) { return ends(i) || is_as_good_at_bound(h, score, parameters[i]); };
    const auto needed = [&](const std::vector<std::size_t>& sizes) {
      Hypothesis without = h;
      for (const std::size_t i : sizes) set_parameter(without, parameters[i], parameters[i].nominal);
      const Score s = evidence_.score(without);
      return !s.finite || cost(without, s) > cost(h, score) + kByChance;
    };
    for (const ParameterGroup& group : groups_of(parameters)) {
      if (std::ranges::any_of(group.shapes, shape_ends) && needed(group.sizes)) return true;
      for (const std::size_t i : group.sizes)
        if (ends(i) && needed({i})) return true;
    }
    return false;
  }

  /// True if a shape is near the end of what is plausible, and the data cannot tell it from there.
  bool is_as_good_at_bound(const Hypothesis& h, const Score& score, const FitParameter& p) const {
    constexpr double kNear = 2;   // times
    if (p.natural_bounds || p.range != SearchRange::own) return false;
    const double value = parameter_value(h, p);
    for (const double bound : {p.lower, p.upper}) {
      if (bound == p.nominal || !(value * bound > 0) || std::abs(std::log(value / bound)) > std::log(kNear)) continue;
      Hypothesis there = h;
      set_parameter(there, p, bound);
      const Score s = evidence_.score(there);
      if (s.finite && cost(there, s) < cost(h, score) + kByChance) return true;
    }
    return false;
  }

  /// True if all sizes of the effect stay within what the model's own tolerance allows: a refit and no effect.
  bool within_tolerance(const Hypothesis& h, int place) const {
    const PlacedEffect& e = h.effects[place];
    const auto parameters = e.effect->parameters(model_.nominal, e.joint);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const EffectParameter& p = parameters[i];
      // Of a number without tolerance a hundredth of its typical size is nothing.
      const double allowed = p.tolerance > 0 ? p.tolerance : 0.01 * std::abs(p.typical - p.neutral);
      if (!p.is_shape() && std::abs(e.p[i] - p.neutral) > allowed) return false;
    }
    return true;
  }

  /// The effect takes a share of a residual, and what it does to some signal is well above what its sensor resolves.
  bool matters(const Score& before, const Score& after, const Hypothesis& h, int place) const {
    bool share = false;
    for (int c = 0; c < evidence_.channels(); ++c)
      share = share || (evidence_.has_channel(c) && before.mean_square[c] - after.mean_square[c] >
                                                        kMattersShare * result_.baseline_score.mean_square[c]);
    if (!share) return false;
    Hypothesis without = h;
    without.effects.erase(without.effects.begin() + place);
    const auto rows = evidence_.fit_rows({h}), bare = evidence_.fit_rows({without});
    if (rows[0].empty() || bare[0].empty()) return !rows[0].empty();
    return evidence_.exceeds_floor(difference(rows[0], bare[0]), kMattersFactor);
  }

  /// What the refit of the baseline costs: ½ Σ ((θ - nominal) / (tolerance / 2))².
  double stretch(const Hypothesis& h) const {
    double sum = 0;
    for (const FitParameter& b : numbers_) {
      const double u = (parameter_value(h, b) - b.nominal) / b.scale;
      sum += 0.5 * u * u;
    }
    return sum;
  }

  Trial judge(const Hypothesis& h, const Score& before, const Likelihood& ln_before, double stretch_before,
              const PlacedEffect& effect) const {
    Trial t = unusable(effect);
    const Score score = evidence_.score(h);
    if (!score.finite) return t;
    t.usable = true;
    t.effect = h.effects.back();
    t.at_bound = at_bound(h, score, static_cast<int>(h.effects.size()) - 1);
    t.is_refit = within_tolerance(h, static_cast<int>(h.effects.size()) - 1);
    t.log_likelihood = log_likelihood(evidence_, score, floors(evidence_));
    t.gain = paired(t.log_likelihood, ln_before, evidence_).sum + stretch_before - stretch(h);
    t.p_value = p_of_gain(score, before, t.gain);
    t.matters = t.p_value < kWorthAFit && matters(before, score, h, static_cast<int>(h.effects.size()) - 1);
    return t;
  }

  /// The probability of such a gain by chance: by the scatter of the blocks, or, of an effect that explains a rest
  /// whole, by the likelihood ratio, so that a few moments are enough.
  double p_of_gain(const Score& with, const Score& without, double gain) const {
    const std::vector<double> least = floors_beside(evidence_, without);
    const double by_blocks =
        p_value(paired(log_likelihood(evidence_, with, least), log_likelihood(evidence_, without, least), evidence_));
    return explains_a_rest(without, with) ? std::min(by_blocks, std::exp(-gain)) : by_blocks;
  }

  /// True if, in the channel with a rest that the effect takes most of, nothing that matters is left or next to
  /// nothing.
  bool explains_a_rest(const Score& before, const Score& after) const {
    const std::vector<bool> had = significant_rest(evidence_, before), has = significant_rest(evidence_, after);
    int most = -1;
    const auto left = [&](int c) { return after.mean_square[c] / before.mean_square[c]; };
    for (int c = 0; c < evidence_.channels(); ++c)
      if (had[c] && (most < 0 || left(c) < left(most))) most = c;
    return most >= 0 && (!has[most] || left(most) < kNextToNone * kNextToNone);
  }

  bool convincing(const Trial& t, std::size_t candidates) const {
    return t.usable && !t.at_bound && !t.is_refit && t.matters && t.gain > 0 &&
           t.p_value * static_cast<double>(candidates) < options_.significance;
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
  bool add_one(Fit& current, Score& score) {
    if (explained(score)) return false;
    const Likelihood ln_before = log_likelihood(evidence_, score, floors(evidence_));
    const std::vector<double> scale = channel_scale(evidence_, score.fit_mean_square);
    // Before any effect is named the baseline's refit is bent by what is missing: the look starts at the model's
    // numbers.
    Fit from = current;
    if (result_.rounds.empty()) from.hypothesis = {model_.nominal, model_.effects};
    std::vector<FitParameter> numbers;
    for (const FitParameter& p : all_parameters(from.hypothesis))
      if (p.effect < 0) numbers.push_back(p);
    const auto columns = sensitivities(evidence_, from.hypothesis, numbers);
    if (columns.empty() && !numbers.empty()) return false;

    const Screen screen(evidence_, from.hypothesis, columns, scale);

    const std::vector<PlacedEffect> all = candidates(current.hypothesis);
    std::vector<Start> starts(all.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
      starts[i] = best_start(evidence_, screen, with_effect(from.hypothesis, all[i]), model_.nominal);
      say("candidates of round " + std::to_string(result_.rounds.size() + 1), static_cast<double>(++done) / all.size());
    });
    std::vector<std::size_t> fitted;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (starts[i].promise >= kPromise) fitted.push_back(i);
    std::stable_sort(fitted.begin(), fitted.end(),
                     [&](std::size_t a, std::size_t b) { return starts[a].left < starts[b].left; });
    if (fitted.size() > kMostFitted) fitted.resize(kMostFitted);

    std::vector<Trial> trials;
    for (const PlacedEffect& candidate : all) {
      trials.push_back(unusable(candidate));
      trials.back().promising = false;
    }
    done = 0;
    tbb::parallel_for(std::size_t{0}, fitted.size(), [&](std::size_t f) {
      const std::size_t i = fitted[f];
      trials[i] = quick_look(starts[i].hypothesis, numbers, columns, scale, score, ln_before,
                             stretch(current.hypothesis), all[i]);
      say("fits of round " + std::to_string(result_.rounds.size() + 1), static_cast<double>(++done) / fitted.size());
    });
    const auto better = [](const Trial& a, const Trial& b) { return a.gain > b.gain; };
    std::stable_sort(trials.begin(), trials.end(), better);

    // The quick look takes the baseline's sensitivities once; for the leaders they are renewed until nothing changes.
    constexpr std::size_t kLeaders = 4;
    constexpr double kLeads = 0.25;   // of the best gain
    std::vector<Fit> fits(std::min(kLeaders, trials.size()));
    std::vector<Trial> leaders(trials.begin(), trials.begin() + fits.size());
    done = 0;
    tbb::parallel_for(std::size_t{0}, fits.size(), [&](std::size_t i) {
      if (!(trials[i].gain > kLeads * trials[0].gain) || trials[i].p_value > kWorthAFit) return;
      fits[i] = refit(with_effect(from.hypothesis, trials[i].effect), score);
      leaders[i] = fits[i].usable
                       ? judge(fits[i].hypothesis, score, ln_before, stretch(current.hypothesis), trials[i].effect)
                       : unusable(trials[i].effect);
      say("best candidates of round " + std::to_string(result_.rounds.size() + 1),
          static_cast<double>(++done) / fits.size());
    });
    std::size_t best = leaders.size();
    for (std::size_t i = 0; i < leaders.size(); ++i)
      if (convincing(leaders[i], fitted.size()) && (best == leaders.size() || leaders[i].gain > leaders[best].gain))
        best = i;

    Round round;
    std::copy(leaders.begin(), leaders.end(), trials.begin());
    if (best < leaders.size()) {
      std::vector<std::size_t> alike = {best};
      for (std::size_t i = 0; i < leaders.size(); ++i) {
        if (i == best || !convincing(leaders[i], fitted.size())) continue;
        const Paired p = paired(leaders[best].log_likelihood, leaders[i].log_likelihood, evidence_);
        if (shared_gain(leaders[best].log_likelihood, leaders[i].log_likelihood, ln_before) < kSharedGain) continue;
        if (p.t < kTellApart || p.sum < 2 * kTellApart * kTellApart) alike.push_back(i);
      }
      // Of those that cannot be told apart the best is named; of those that are as good one that only changes the
      // model's own numbers, and then the one with the fewest numbers of its own.
      const auto simplicity = [&](std::size_t i) {
        const PlacedEffect& e = leaders[i].effect;
        return std::pair(e.effect->stages() != 0, e.effect->parameters(model_.nominal, e.joint).size());
      };
      std::vector<std::size_t> as_good = alike;
      std::erase_if(as_good, [&](std::size_t i) { return leaders[i].gain < leaders[best].gain - kByChance; });
      best = *std::ranges::min_element(as_good, {}, simplicity);
      std::vector<PlacedEffect> like;
      for (const std::size_t i : alike)
        if (i != best) like.push_back(leaders[i].effect);
      result_.alternatives.push_back(like);
      current = fits[best];
      score = evidence_.score(current.hypothesis);
      if (!result_.rounds.empty()) fit_afresh(current, score);
      round.accepted = true;
      std::swap(trials[0], trials[best]);
    }
    round.trials = std::move(trials);
    result_.rounds.push_back(std::move(round));
    return best < leaders.size();
  }

  Trial quick_look(const Hypothesis& start, const std::vector<FitParameter>& numbers,
                   const std::vector<std::vector<double>>& columns, const std::vector<double>& scale,
                   const Score& before, const Likelihood& ln_before, double stretch_before,
                   const PlacedEffect& effect) const {
    std::vector<FitParameter> parameters;
    std::vector<std::vector<double>> kept;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (effect_covers(effect, model_.nominal, numbers[i])) continue;
      parameters.push_back(numbers[i]);
      kept.push_back(columns[i]);
    }
    for (const FitParameter& p : all_parameters(start))
      if (p.effect >= 0) parameters.push_back(p);
    FitOptions options;
    options.iterations = 6;
    options.cost_tolerance = 3e-4;
    options.frozen_baseline = true;
    const Fit f = fit(evidence_, start, parameters, scale, options, kept);
    return f.usable ? judge(f.hypothesis, before, ln_before, stretch_before, effect) : unusable(effect);
  }

  /// Each effect is tried for removal: one that a later one made idle goes.
  void remove_idle(Fit& current, Score& score) {
    while (current.hypothesis.effects.size() > given_) {
      const std::size_t n = current.hypothesis.effects.size() - given_;
      std::vector<Fit> without(n, result_.baseline);
      if (n > 1)
        tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
          Hypothesis h = current.hypothesis;
          h.effects.erase(h.effects.begin() + given_ + i);
          without[i] = refit(h, score);
        });
      std::size_t gone = n;
      Score left;
      for (std::size_t i = 0; i < n && gone == n; ++i) {
        if (!without[i].usable) continue;
        left = evidence_.score(without[i].hypothesis);
        if (left.finite && is_idle(current.hypothesis, score, without[i].hypothesis, left, i)) gone = i;
      }
      if (gone == n) break;
      current = without[gone];
      score = left;
      result_.alternatives.erase(result_.alternatives.begin() + gone);
    }
  }

  /// True if the i-th of the added effects is not needed, by what is left with it and without.
  bool is_idle(const Hypothesis& with, const Score& with_score, const Hypothesis& without, const Score& without_score,
               std::size_t i) const {
    const int place = static_cast<int>(given_ + i);
    const std::vector<double> least = floors(evidence_);
    const double gain =
        paired(log_likelihood(evidence_, with_score, least), log_likelihood(evidence_, without_score, least), evidence_)
            .sum +
        stretch(without) - stretch(with);
    return within_tolerance(with, place) || !matters(without_score, with_score, with, place) ||
           p_of_gain(with_score, without_score, gain) > options_.significance;
  }

  const Evidence& evidence_;
  const ArmModel& model_;
  const AttributionOptions& options_;
  const std::function<void(const std::string&, double)>& progress_;
  std::vector<FitParameter> numbers_;   ///< baseline numbers that the data can tell something of
  std::size_t given_ = 0;   ///< effects that the model came with
  Attribution result_;
};

}  // namespace

std::vector<PlacedEffect> all_candidates(const ArmParameters<double>& arm) {
  std::vector<PlacedEffect> all;
  for (const Effect* effect : effect_library()) {
    std::vector<int> places = effect_places(*effect, arm);
    // Of a single joint "at all joints alike" says nothing more than "at joint 1".
    if (effect->scope() == EffectScope::either && arm.n == 1) std::erase(places, -1);
    for (const int joint : places) all.push_back(place_effect(*effect, arm, joint));
  }
  return all;
}

std::vector<double> difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t r = 0; r < a.size(); ++r) a[r] -= b[r];
  return a;
}

std::vector<bool> significant_rest(const Evidence& evidence, const Score& score) {
  std::vector<bool> rest(evidence.channels(), false);
  for (int c = 0; c < evidence.channels(); ++c)
    rest[c] = evidence.has_channel(c) && std::sqrt(score.mean_square[c]) > kRestFactor * evidence.floor()[c];
  return rest;
}

Attribution attribute(const Evidence& evidence, const ArmModel& model, const AttributionOptions& options,
                      const std::function<void(const std::string&, double)>& progress) {
  return Search(evidence, model, options, progress).run();
}

}  // namespace halyard

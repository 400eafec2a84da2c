#include "diagnosis/search/attribution.h"

#include <algorithm>

#include "diagnosis/prediction/room.h"
#include "diagnosis/prediction/side_by_side.h"
#include "diagnosis/search/compete.h"
#include "diagnosis/search/pair_rivals.h"

namespace halyard {
namespace {

/// Each costs a round.
constexpr int kMostBetterFits = 3;

class Search {
 public:
  Search(const Evidence& evidence, const ArmModel& model, const AttributionOptions& options,
         const SearchProgress& progress)
      : evidence_(evidence),
        stated_(model),
        options_(options),
        progress_(progress),
        given_(model.effects.size()),
        basis_(std::make_unique<Basis>(evidence, model, 1, given_)) {
    const Hypothesis nominal{model.nominal, model.effects};
    result_.nominal_score = evidence_.score(nominal);
    if (result_.nominal_score.finite && basis_->refitter.is_usable())
      baseline_ = basis_->refitted(nominal, result_.nominal_score);
    if (!baseline_.fit.usable) refuse_to_predict(model, "measured motion");
  }

  Attribution run() {
    Found current = baseline_;
    do {
      while (n_added(current) < options_.most_effects && add(current))
        if (n_added(current) > 1) widen(current);
    } while (widen(current));
    narrow(current);
    without_ = without_each(current);
    revise_names(current);
    remove_idle(current);
    result_.baseline = baseline_.fit;
    result_.baseline_score = baseline_.score;
    result_.final_fit = std::move(current.fit);
    result_.final_score = std::move(current.score);
    result_.tolerance_factor = basis_->factor;
    PairRivals(evidence_, basis_->model, basis_->refitter, basis_->judge, given_, options_).weigh(result_);
    return std::move(result_);
  }

 private:
  int n_added(const Found& f) const { return static_cast<int>(f.fit.hypothesis.effects.size() - given_); }

  /// Wider tolerances, if these are more probable with the same names or fewer. False if not.
  bool widen(Found& current) {
    if (basis_->factor >= kRule.widest_tolerances || !basis_->is_narrow(current.fit.hypothesis)) return false;
    if (n_added(current) == 0 && explained(current.score)) return false;
    const double cost = basis_->judge.cost(current.scored());
    if (cost == refused_ || !rebase(current, 2 * basis_->factor)) {
      refused_ = cost;
      return false;
    }
    result_.no_effect = 1;
    better_fits_ = 0;
    return true;
  }
  /// Effects that were found later may have made wider tolerances needless.
  void narrow(Found& current) {
    const double widest = basis_->factor;
    for (double factor = 1; factor < widest; factor *= 2)
      if (rebase(current, factor)) return;
  }
  bool rebase(Found& current, double factor) {
    progress_("wider tolerances", 0);
    std::optional<Rebased> to = rebased(evidence_, stated_, factor, *basis_, current);
    if (!to) return false;
    basis_ = std::move(to->basis);
    baseline_ = std::move(to->baseline);
    current = std::move(to->found);
    std::vector<Naming> kept;
    for (const std::size_t i : to->kept) kept.push_back(result_.namings[i]);
    result_.namings = std::move(kept);
    result_.rounds.push_back({.trials = {}, .tolerance_factor = factor, .gone = std::move(to->gone)});
    last_name_competed_ = false;
    return true;
  }

  /// A fit from the model's own numbers: while effects were still missing, the fits had distorted the numbers.
  Found afresh(const Found& current) const {
    const Hypothesis& h = current.fit.hypothesis;
    return refitted({basis_->model.nominal, h.effects, h.past}, current.score);
  }
  bool is_better(const Found& f, const Found& than) const {
    return f.fit.usable && f.score.finite && basis_->judge.cost(f.scored()) < basis_->judge.cost(than.scored());
  }

  std::vector<PlacedEffect> candidates(const Hypothesis& h) const {
    return candidates_beside(evidence_, h, basis_->model.nominal);
  }

  /// True if no channel has a residual left above its floor.
  bool explained(const Score& score) const {
    for (int c = 0; c < evidence_.channels(); ++c)
      if (is_beyond_noise(evidence_, score.mean_square, c) || is_beyond_noise(evidence_, score.fit_mean_square, c))
        return false;
    return true;
  }

  CandidateRound round_of(const Found& without, const Hypothesis& from, const std::string& name) const {
    return {evidence_, basis_->model, basis_->refitter, basis_->judge, without.scored(), from, name, progress_};
  }

  RoundOutcome compete(CandidateRound& round, const Found& without, const std::vector<PlacedEffect>& candidates,
                       const std::optional<Standing>& standing = {}) {
    RoundOutcome outcome =
        halyard::compete(evidence_, *basis_, options_.significance, round, without.scored(), candidates, standing);
    result_.rounds.push_back(std::move(outcome.told));
    return outcome;
  }

  /// One round with all candidates, and if none of them is convincing alone, with several at once.
  bool add(Found& current) {
    if (explained(current.score)) return false;
    const bool is_first = result_.rounds.empty();
    const Hypothesis so_far = current.fit.hypothesis;
    const auto next_round = [&](const Hypothesis& from) {
      return round_of(current, from, "round " + std::to_string(result_.rounds.size() + 1));
    };
    // Before any effect is named, the missing effects distort the refitted baseline: candidates start at the model's
    // own parameters. But if these are far off, the residual is not linear in them, and a small effect is lost beside
    // this.
    CandidateRound round =
        next_round(is_first ? Hypothesis{basis_->model.nominal, basis_->model.effects, so_far.past} : so_far);
    RoundOutcome outcome = compete(round, current, candidates(so_far));
    const bool is_from_the_model = is_first && outcome.won;
    if (!outcome.won && is_first) {
      CandidateRound second = next_round(so_far);
      outcome = compete(second, current, candidates(so_far));
    }
    const std::optional<Won>& won = outcome.won;
    if (!won) {
      result_.no_effect = outcome.no_effect;
      return add_together(current, round);
    }
    Found with{won->fit, evidence_.score(won->fit.hypothesis)}, without, again;
    run_side_by_side(is_from_the_model ? 1 : 2,
                     [&](std::size_t i) { i == 0 ? without = without_last(with) : again = afresh(with); });
    if (!convinces_against_its_own_fit(current, with, std::move(without))) return ++better_fits_ <= kMostBetterFits;
    current = std::move(is_better(again, with) ? again : with);
    result_.namings.push_back(won->naming);
    last_name_competed_ = true;
    return true;
  }

  Found refitted(const Hypothesis& h, const Score& before) const { return basis_->refitted(h, before); }
  Found without_last(const Found& with) const {
    return refitted(without_effect(with.fit.hypothesis, with.fit.hypothesis.effects.size() - 1), with.score);
  }
  /// Fits without each of the added effects, side by side.
  std::vector<Found> without_each(const Found& current) const {
    if (n_added(current) == 1) return {baseline_};
    return basis_->without_each(current);
  }

  /// Fits with several effects have several minima. A candidate may win because its fit found a better one for
  /// everything else. Therefore the hypothesis without it is fitted again from where the winner ended. If this fits
  /// better, it replaces `current`, and the winner has to convince against it. If it does not, the next round starts
  /// from there. without: without_last(with).
  bool convinces_against_its_own_fit(Found& current, const Found& with, Found without) {
    if (!without.fit.usable || !without.score.finite ||
        basis_->judge.cost(without.scored()) + kRule.by_chance > basis_->judge.cost(current.scored()))
      return true;
    current = std::move(without);
    if (n_added(current) == 0) baseline_ = current;
    Round& told = result_.rounds.back();
    told.trials[0] = basis_->judge.trial(with.fit.hypothesis, current.scored(), with.fit.hypothesis.effects.size() - 1);
    told.accepted = convincing(told.trials, options_.significance)[0];
    return told.accepted;
  }

  /// Several effects at once, if that was not done yet.
  bool add_together(Found& current, const CandidateRound& round) {
    for (auto told = result_.rounds.rbegin(); told != result_.rounds.rend() && !told->tolerance_factor; ++told)
      if (told->at_once) return false;
    progress_("several effects at once", 0);
    const JointSearch search(evidence_, basis_->refitter, basis_->judge, given_);
    const JointProposal proposal = search.propose(round.linear(), current.scored(), options_.significance,
                                                  options_.most_effects - n_added(current));
    if (proposal.trials.empty()) return false;
    result_.rounds.push_back({.trials = proposal.trials, .accepted = proposal.is_convincing, .at_once = true});
    if (!proposal.is_convincing) return false;
    for (const Trial& t : proposal.trials)
      result_.namings.push_back(
          Competition(evidence_, basis_->model, basis_->judge, current.scored(), {t}).naming({0, {0}}));
    last_name_competed_ = false;
    current = {proposal.fit, proposal.score};
    Found again = afresh(current);
    if (is_better(again, current)) current = std::move(again);
    return true;
  }

  /// Each name was given while other effects were still missing. All candidates that had gained something compete for
  /// its place once more, beside the other effects, and so does the name itself. A name stays if it wins, if it loses
  /// to a fit that gains less, or if nobody wins and it is still needed.
  void revise_names(Found& current) {
    const std::vector<PlacedEffect> pool = gainers();
    const std::size_t all = result_.namings.size();
    std::size_t n = all - (last_name_competed_ ? 1 : 0);
    std::size_t kept = 0;  // names that have been revised and stay in front of the others
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t place = given_ + kept;
      const PlacedEffect old = current.fit.hypothesis.effects[place];
      const Hypothesis others = without_effect(current.fit.hypothesis, place);
      const Found without = without_[kept];
      if (!without.fit.usable) {
        ++kept;
        continue;
      }
      std::vector<PlacedEffect> rivals = candidates(others);
      std::erase_if(rivals, [&](const PlacedEffect& r) {
        return std::ranges::none_of(pool, [&](const PlacedEffect& p) { return same_name(p, r); });
      });
      CandidateRound round = round_of(without, without.fit.hypothesis, "the revision of name " + std::to_string(i + 1));
      const std::optional<Won> won = compete(round, without, rivals, Standing{current, place}).won;
      Round& told = result_.rounds.back();
      told.revised = old;
      const auto naming = result_.namings.begin() + static_cast<std::ptrdiff_t>(kept);
      const bool is_same = won && same_name(won->effect, old);
      if (is_same) *naming = won->naming;
      Found revised = won ? Found{won->fit, evidence_.score(won->fit.hypothesis)} : without;
      if (won ? won->is_standing || (!is_same && loses_to(current, revised)) : is_needed(current, without, place)) {
        told.accepted = false;
        told.name_stays = true;
        if (!is_same) *naming = naming_beside_rivals(current, without, place);
        ++kept;
        continue;
      }
      const Naming its = won ? won->naming : Naming{};
      result_.namings.erase(naming);
      if (won) result_.namings.push_back(its);
      change(current, std::move(revised));
      n = all;  // the last name competed beside an effect that has changed
    }
  }

  /// The naming of an effect that stays, among the candidates of the round in which its name was revised.
  Naming naming_beside_rivals(const Found& current, const Found& without, std::size_t place) const {
    std::vector<Trial> trials = {basis_->judge.trial(current.fit.hypothesis, without.scored(), place)};
    for (const Trial& t : result_.rounds.back().trials)
      if (!same_name(t.effect, trials[0].effect)) trials.push_back(t);
    return Competition(evidence_, basis_->model, basis_->judge, without.scored(), trials).naming({0, {0}});
  }

  /// Without the effect, another one may end at a bound to replace it. That is no explanation.
  bool is_needed(const Found& with, const Found& without, std::size_t place) const {
    return basis_->judge.is_needed(with.scored(), without.scored(), place, options_.significance) ||
           (basis_->judge.leans_on_a_bound(without.scored()) && !basis_->judge.leans_on_a_bound(with.scored()));
  }

  /// True if another name that has won a revision gains less than the name before it: its fit in this round may miss
  /// what the earlier fit had found.
  bool loses_to(const Found& before, const Found& revised) const {
    return basis_->judge.gain_over(before.scored(), revised.scored()) > kRule.by_chance;
  }

  /// Candidates that gained in any round.
  std::vector<PlacedEffect> gainers() const {
    std::vector<PlacedEffect> all;
    for (const Round& round : result_.rounds)
      for (const Trial& t : round.trials)
        if (t.usable && t.gain > 0) all.push_back(t.effect);
    return all;
  }

  /// Removes each effect that a later one has made unnecessary.
  void remove_idle(Found& current) {
    const auto is_idle = [&](std::size_t i) {
      const Found& left = without_[i];
      return left.fit.usable && left.score.finite && !is_needed(current, left, given_ + i);
    };
    for (;;) {
      std::size_t gone = 0;
      while (gone < without_.size() && !is_idle(gone)) ++gone;
      if (gone == without_.size()) return;
      change(current, Found(without_[gone]));
      result_.namings.erase(result_.namings.begin() + static_cast<std::ptrdiff_t>(gone));
    }
  }

  void change(Found& current, Found to) {
    current = std::move(to);
    without_ = without_each(current);
  }

  const Evidence& evidence_;
  const ArmModel& stated_;
  const AttributionOptions& options_;
  const SearchProgress& progress_;
  std::size_t given_;  ///< effects that the model came with
  std::unique_ptr<const Basis> basis_;
  Found baseline_;  ///< without added effects
  Attribution result_;
  std::vector<Found> without_;       ///< after the rounds: fits without each added effect
  bool last_name_competed_ = false;  ///< it won a round beside all the others
  std::optional<double> refused_;    ///< cost of the fit with which wider tolerances were less probable
  int better_fits_ = 0;              ///< rounds without a name that ended with a better fit of the effects so far
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
  const SearchProgress say = progress ? progress : [](const std::string&, double) {};
  say("nominal model", 0);
  return Search(evidence, model, options, say).run();
}

}  // namespace halyard

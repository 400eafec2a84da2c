#include "diagnosis/search/revision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "diagnosis/fit/complementary.h"
#include "diagnosis/judgement/final_fit.h"
#include "diagnosis/judgement/name_probability.h"
#include "diagnosis/prediction/side_by_side.h"
#include "diagnosis/round/refit.h"

namespace halyard {
namespace {

/// The values, deviations and resets of a fit, as they are numbered without an effect.
Fit counted_without(const Fit& f, std::size_t gone) {
  Fit left;
  left.parameters = without_parameters_of(f.parameters, gone);
  for (std::size_t i = 0; i < f.parameters.size(); ++i)
    if (f.parameters[i].effect != gone)
      left.value.push_back(f.value[i]), left.std_deviation.push_back(f.std_deviation[i]);
  for (ResetParameter r : f.reset) {
    if (r.parameter.effect == gone) continue;
    if (r.parameter.effect > gone) --*r.parameter.effect;
    left.reset.push_back(r);
  }
  return left;
}

class Revision {
 public:
  Revision(const Evidence& evidence, const Evidence& whole, const ArmModel& given, Attribution& found)
      : evidence_(evidence), whole_(whole), model_(given), given_(given.effects.size()), found_(found) {}

  std::vector<std::size_t> run() {
    fit_finally(found_.final_fit);
    return run_from_here();
  }
  /// found: it has been revised before.
  std::vector<std::size_t> run_from_here() {
    while (drop_one() || join_one()) {}
    const std::vector<std::size_t> changed = changed_numbers(whole_, model_, found_.final_fit);
    // A model that lacks nothing stays as it is.
    if (changed.empty() && effects().size() == given_) give_numbers_back();
    return changed;
  }
  bool has_one_to_drop() const { return effect_to_drop().has_value(); }

 private:
  const std::vector<PlacedEffect>& effects() const { return found_.final_fit.hypothesis.effects; }

  /// False if the start cannot be integrated: then all stays as it is. gone: the effect that the start lacks.
  bool fit_finally(const Fit& start, std::optional<std::size_t> gone = {}) {
    Fit fit = final_fit(whole_, model_, start, given_);
    if (!fit.usable) return false;
    if (gone) keep_resets(counted_without(found_.final_fit, *gone), fit);
    take(fit);
    return true;
  }

  /// What was reset before is not in the start of a later fit; it stays reset.
  static void keep_resets(const Fit& before, Fit& fit) {
    for (const ResetParameter& r : before.reset) {
      const auto is_its = [&](const ResetParameter& later) { return is_same_number(later.parameter, r.parameter); };
      if (!find_parameter(fit.parameters, r.parameter) && has_a_size(fit, *r.parameter.effect) &&
          std::ranges::none_of(fit.reset, is_its))
        fit.reset.push_back(r);
    }
    count_resets(before, fit);
  }

  void take(const Fit& fit) {
    found_.final_fit = fit;
    found_.final_score = evidence_.score(fit.hypothesis);
  }

  void give_numbers_back() {
    if (const Fit as_given = with_given_numbers(whole_, model_, found_.final_fit); as_given.usable) take(as_given);
  }

  bool drop_one() {
    const std::optional<std::size_t> gone = effect_to_drop();
    if (!gone || !fit_finally(start_without(*gone), gone)) return false;
    found_.namings.erase(found_.namings.begin() + static_cast<std::ptrdiff_t>(*gone - given_));
    return true;
  }

  std::optional<std::size_t> effect_to_drop() const {
    if (const auto idle = idle_effects(found_.final_fit, given_); !idle.empty()) return idle.back();
    const std::vector<double> none = probabilities_of_none(evidence_, found_, given_);
    for (std::size_t e = given_; e < effects().size(); ++e)
      if (is_event(effects()[e], model_.nominal) && is_doubtful(found_.namings[e - given_], none[e - given_])) return e;
    return {};
  }

  /// The numbers of the model that the effect had replaced are fitted again.
  Fit start_without(std::size_t effect) const {
    const Fit& with = found_.final_fit;
    const PlacedEffect& gone = with.hypothesis.effects[effect];
    Fit start;
    start.hypothesis = without_effect(with.hypothesis, effect);
    start.parameters = without_parameters_of(with.parameters, effect);
    const auto covers = [&](const PlacedEffect& e, const FitParameter& p) {
      return effect_covers(e, model_.nominal, p);
    };
    const std::vector<PlacedEffect>& left = start.hypothesis.effects;
    const auto added = left.begin() + static_cast<std::ptrdiff_t>(given_);
    for (const FitParameter& p : found_.baseline.parameters)
      if (!p.effect && covers(gone, p) &&
          std::none_of(added, left.end(), [&](const PlacedEffect& e) { return covers(e, p); }))
        start.parameters.push_back(p);
    return start;
  }

  bool join_one() {
    const auto joined = join_complementary(found_.final_fit, given_);
    if (!joined) return false;
    Fit start;
    start.hypothesis = joined->hypothesis;
    start.parameters = joined->parameters;
    if (!fit_finally(start, joined->gone)) return false;
    const auto gone = found_.namings.begin() + static_cast<std::ptrdiff_t>(joined->gone - given_);
    Naming& kept = found_.namings[joined->kept - given_];
    if (gone->weight > kept.weight) kept = std::move(*gone);
    found_.namings.erase(gone);
    return true;
  }

  const Evidence& evidence_;
  const Evidence& whole_;
  const ArmModel& model_;
  std::size_t given_;  ///< effects that the model came with
  Attribution& found_;
};

}  // namespace

std::vector<std::size_t> revise(const Evidence& evidence, const Evidence& whole, const ArmModel& given,
                                Attribution& found) {
  return Revision(evidence, whole, given, found).run();
}

std::vector<std::size_t> drop_doubtful_events(const Evidence& evidence, const Evidence& whole, const ArmModel& given,
                                              Attribution& found, std::vector<std::size_t> changed) {
  Revision revision(evidence, whole, given, found);
  return revision.has_one_to_drop() ? revision.run_from_here() : changed;
}

namespace {

Hypothesis without_added_at(Hypothesis h, std::size_t given, EffectPlace joint) {
  for (std::size_t e = h.effects.size(); e-- > given;)
    if (h.effects[e].joint == joint) h = without_effect(h, e);
  return h;
}

/// By what is left in the channel in which the effect does most.
double probability_of_none_by_rest(const Evidence& evidence, const Attribution& found, std::size_t given,
                                   std::size_t effect) {
  const Hypothesis& h = found.final_fit.hypothesis;
  const Score without = evidence.score(without_effect(h, effect));
  if (!without.finite) return 0;
  const std::optional<int> c = most_explained_channel(evidence, found.final_score, without);
  if (!c) return 0;
  double before = without.mean_square[*c];
  if (const Score none = evidence.score(without_added_at(h, given, h.effects[effect].joint)); none.finite)
    before = std::min(before, none.mean_square[*c]);
  const double misfit_square = std::pow(misfit_of(h.effects[effect]), 2) * before;
  return probability_of_none(found.final_score.mean_square[*c], misfit_square, evidence.floor()[*c]);
}

}  // namespace

double probability_of_none_for(const Evidence& evidence, const Attribution& found, std::size_t given,
                               std::size_t effect) {
  return std::max(found.namings[effect - given].unlisted.weight,
                  probability_of_none_by_rest(evidence, found, given, effect));
}

std::vector<double> probabilities_of_a_rest(const Evidence& evidence, const Score& score,
                                            const std::vector<double>& misfit) {
  std::vector<double> none(static_cast<std::size_t>(evidence.channels()), 0);
  for (std::size_t c = 0; c < none.size(); ++c)
    if (const int channel = static_cast<int>(c); evidence.has_channel(channel))
      none[c] = probability_of_none(score.mean_square[c], misfit[c] / (kRule.rest_ratio * kRule.rest_ratio),
                                    evidence.floor()[c]);
  return none;
}

std::vector<double> probabilities_of_none(const Evidence& evidence, const Attribution& found, std::size_t given) {
  const Hypothesis& h = found.final_fit.hypothesis;
  std::vector<std::size_t> added(h.effects.size() - given);
  std::iota(added.begin(), added.end(), given);
  const std::vector<double> rest =
      probabilities_of_a_rest(evidence, found.final_score, mean_square_misfit(evidence, {h, found.final_score}, added));
  std::vector<double> none;
  for (const std::size_t e : added) {
    none.push_back(probability_of_none_for(evidence, found, given, e));
    if (const EffectPlace joint = h.effects[e].joint)
      for (const int channel : {*joint, h.nominal.n + *joint})
        none.back() = std::max(none.back(), kRule.wrong_beside_a_rest * rest[static_cast<std::size_t>(channel)]);
  }
  return none;
}

bool is_doubtful(const Naming& naming, double none) {
  return probability_of_any_name(naming, none) < kRule.worth_a_name;
}

namespace {

/// False if it may only make up for something else: then others may be needed only beside it.
bool is_there(Doubt doubt) { return doubt == Doubt::none || doubt == Doubt::guess; }

/// The final fit asks whether a size is certain if its shapes were known. This asks whether it is certain beside them,
/// and beside numbers of the model anywhere within their tolerances.
bool has_certain_size(const Fit& fit, std::size_t effect) {
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    if (fit.parameters[i].effect == effect && !fit.parameters[i].shape && !may_be_neutral(fit, i)) return true;
  return false;
}

Doubt own_doubt(const Naming& naming, const Fit& fit, std::size_t effect, double none) {
  if (is_doubtful(naming, none)) return Doubt::another_cause;
  if (naming.surer) return Doubt::surer_rival;
  if (!has_certain_size(fit, effect)) return Doubt::no_certain_size;
  return naming.weight < kRule.sure_name ? Doubt::guess : Doubt::none;
}

/// The most probable name of a single effect is told with its alternatives if it is more probable than not, or if it is
/// either this one or one other: the two form the set that is reported. Otherwise it is a guess, whatever its weight.
Doubt doubt_of_single_name(const Naming& naming, double none) {
  const double either = naming.weight + (naming.alternatives.empty() ? 0 : naming.alternatives[0].probability);
  const bool is_told = naming.weight * (1 - none) > kRule.worth_a_name || either * (1 - none) > kRule.set_share;
  return is_told ? Doubt::none : Doubt::guess;
}

/// "backlash of joint 3 (27 %) or hysteresis of joint 3 (9 %)": alternatives of some weight.
std::string others(const Naming& naming, double none) {
  constexpr double kWorthMentioning = 0.05;
  std::string text;
  for (const Alternative& a : naming.alternatives)
    if (const double p = told_probability(a.probability, none); p > kWorthMentioning)
      text += fmt::format("{}{} ({:.0f} %)", text.empty() ? "" : " or ", effect_label(a.effect), 100 * p);
  return text;
}

}  // namespace

std::vector<Doubt> doubts(const Evidence& evidence, const ArmModel& given, const Attribution& found,
                          const std::vector<double>& none, double significance) {
  const std::size_t first = given.effects.size();
  const Hypothesis& all = found.final_fit.hypothesis;
  std::vector<Doubt> doubt(all.effects.size() - first, Doubt::none);
  Hypothesis sure = all;
  for (std::size_t e = all.effects.size(); e-- > first;) {
    doubt[e - first] = own_doubt(found.namings[e - first], found.final_fit, e, none[e - first]);
    if (!is_there(doubt[e - first])) sure = without_effect(sure, e);
  }
  if (std::ranges::count_if(doubt, is_there) == 1) {
    const auto only = static_cast<std::size_t>(std::ranges::find_if(doubt, is_there) - doubt.begin());
    doubt[only] = doubt_of_single_name(found.namings[only], none[only]);
  }
  if (sure.effects.size() == all.effects.size()) return doubt;
  const Refitter refitter(evidence, given, first);
  if (!refitter.is_usable()) return doubt;
  const Judge judge(evidence, given, baseline_parameters(given));
  // With all that are sure at first, then without each of them.
  std::vector<std::optional<Scored>> fitted(sure.effects.size() - first + 1);
  run_side_by_side(fitted.size(), [&](std::size_t i) {
    fitted[i] = refitter.refitted(i == 0 ? sure : without_effect(sure, first + i - 1), found.final_score);
  });
  for (std::size_t e = 0, i = 1; e < doubt.size(); ++e) {
    if (!is_there(doubt[e])) continue;
    if (fitted[0] && fitted[i] && !judge.is_needed(*fitted[0], *fitted[i], first + i - 1, significance))
      doubt[e] = Doubt::only_beside_one;
    ++i;
  }
  return doubt;
}

std::string reason_of(Doubt doubt, const Naming& naming, double none, const std::vector<PlacedEffect>& found) {
  switch (doubt) {
    case Doubt::another_cause:
      return naming.unlisted.weight > kRule.worth_a_name
                 ? naming.unlisted.summary + ", which the library lacks, explains it better"
                 : "so much is left that another cause is more probable";
    case Doubt::surer_rival: {
      const bool repeats =
          std::ranges::any_of(found, [&](const PlacedEffect& e) { return same_name(e, *naming.surer); });
      return fmt::format("{}{} is more probable, though not sure enough for a name either", repeats ? "another " : "",
                         effect_label(*naming.surer));
    }
    case Doubt::guess: {
      const std::string other = others(naming, none);
      return fmt::format("its name is a guess ({:.0f} %): {}", 100 * told_probability(naming.weight, none),
                         other.empty() ? "another cause may as well be right" : "it may be " + other);
    }
    case Doubt::no_certain_size: return "its size may as well be zero";
    case Doubt::only_beside_one: return "it is needed only beside another effect that has no name";
    case Doubt::none: break;
  }
  return "";
}

std::string reason_of_refusal(const std::vector<PlacedEffect>& added) {
  std::string what;
  for (const PlacedEffect& e : added) what += (what.empty() ? "" : ", ") + effect_label(e);
  return fmt::format("{} would explain the training data, but predict this joint worse on the hold-out",
                     what.empty() ? "refitted parameters" : what);
}

}  // namespace halyard

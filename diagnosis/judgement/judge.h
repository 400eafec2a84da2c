#pragma once
/// Decides whether a fitted effect explains something.
///
///   gain = Σ_b (ln L_b with the effect - ln L_b without)     likelihood.h, on the deciding blocks
///          + prior cost without - prior cost with
///   prior cost = ½ Σ ((θ - nominal) / (tolerance / 2))²       of the refitted baseline parameters θ
///
/// An effect is named if
///
/// - its gain is positive, and what it explains is significant, corrected for the number of candidates
///   (false_discovery.h). The test is a t test over blocks (nested_gain.h). An effect that explains nearly all of a
///   remaining residual is also tested by the likelihood ratio on data that the fit did not use,
///   p = 2 min(p of t, exp(-Σ_b Δ ln L_b)), so that a force during two of sixty blocks is found. This approximates the
///   split likelihood ratio of Wasserman, Ramdas and Balakrishnan, PNAS 117 (2020). Their bound compares with the
///   largest likelihood that a hypothesis without the effect can have on the deciding data. Here both hypotheses are
///   fitted on the other blocks. Blind trials of clean arms measure its false-positive rate;
/// - it matters: a residual shrinks by more than the model's tolerances and the sensors' errors can explain, or the
///   prior cost falls by much;
/// - no parameter that matters lies at its plausible bound. No shape lies within a factor of two of such a bound if the
///   bound itself has an equal likelihood. The ends of the record and of the motion are the bounds of a push;
/// - one of its sizes at least exceeds the tolerance of the number that it changes. Otherwise it is a refit;
/// - it needs the parameters that make it this effect: without them it explains significantly less.

#include <optional>

#include "diagnosis/fit/fit.h"
#include "diagnosis/judgement/decision_rule.h"
#include "diagnosis/judgement/likelihood.h"

namespace halyard {

/// A candidate and the results of its tests.
struct Trial {
  PlacedEffect effect;
  bool promising = true;  ///< false: even at its best start it explains too little of the residual to be fitted
  bool is_fitted = true;  ///< it was among the candidates that leave the smallest residual
  bool usable = false;    ///< it could be integrated
  double gain = 0;        ///< on the deciding blocks, above the hypothesis without it
  double prior_cost = 0;  ///< of the baseline's numbers with it
  double p_value = 1;     ///< of no gain, without correction for the number of candidates
  bool is_judged() const { return usable && p_value <= kRule.worth_a_fit; }
  // Valid if is_judged():
  bool at_bound = false;
  bool is_refit = false;  ///< its sizes stay within the model's tolerance
  bool matters = false;
  bool is_another = false;  ///< another effect explains as much, see is_another_effect()
  Likelihood log_likelihood;

  /// True if only the significance of its gain is left to be tested.
  bool can_be_named() const { return is_judged() && gain > 0 && !at_bound && !is_refit && matters && !is_another; }
  bool passes(double significance) const { return can_be_named() && p_value <= significance; }
};

Trial unusable(const PlacedEffect& effect);

/// A hypothesis and its score.
struct Scored {
  Hypothesis hypothesis;
  Score score;
};

/// [2n] True for channels whose residual on the deciding blocks is well above the channel's floor, and above what the
/// effects that were found may miss. misfit: mean_square_misfit(), or nothing.
std::vector<bool> significant_rest(const Evidence& evidence, const Score& score,
                                   const std::vector<double>& misfit = {});

/// True if noise alone does not explain these residuals of a channel: they are above explained_ratio times the floor.
/// mean_square: [2n].
bool is_beyond_noise(const Evidence& evidence, const std::vector<double>& mean_square, int channel);

/// The channel whose mean square on the deciding blocks an effect lowers most, in squares of the channel's floor;
/// nothing if it lowers none.
std::optional<int> most_explained_channel(const Evidence& evidence, const Score& with, const Score& without);

/// What an effect may miss although it is the right one, relative to what it does: form_misfit of decision_rule.h, or
/// number_misfit if it has no equation of its own.
double misfit_of(const PlacedEffect& effect);

/// True for an effect that changes how a cable stretches or pulls, and is not an event.
bool yields_in_the_cable(const PlacedEffect& effect, const ArmParameters<double>& arm);

/// True for two effects in one cable, none of them an event: both change how far it yields under its load, so that the
/// second can mend the form of the first.
bool mends_the_form_of(const PlacedEffect& candidate, const PlacedEffect& found, const ArmParameters<double>& arm);

/// What these effects of a hypothesis may miss, all together: sums of squares, [deciding block][2n]. What they do to
/// the residuals is more than what they have removed, if the model's refitted numbers had hidden a part of it. A
/// constant that they do all the time does not count: what is missed of it is a constant, too, and their own sizes
/// absorb it.
std::vector<std::vector<double>> misfits(const Evidence& evidence, const Scored& found,
                                         const std::vector<std::size_t>& effects);
/// The same as mean squares over the deciding blocks, [2n].
std::vector<double> mean_square_misfit(const Evidence& evidence, const Scored& found,
                                       const std::vector<std::size_t>& effects);

/// a - b, row by row; both have the same length.
std::vector<double> difference(std::vector<double> a, const std::vector<double>& b);

class Judge {
 public:
  /// numbers: baseline parameters that a fit may have changed.
  Judge(const Evidence& evidence, const ArmModel& model, std::vector<FitParameter> numbers);

  /// Tests the effect with index `place` in `with` against the hypothesis without it.
  Trial trial(const Hypothesis& with, const Scored& without, std::size_t place) const;
  /// True if the effect with index `place` in `with` is still needed.
  bool is_needed(const Scored& with, const Scored& without, std::size_t place, double significance) const;

  /// Probability of such a gain by chance.
  double p_of_gain(const Score& with, const Score& without) const;
  /// The gain of `a` above `b`: what it explains more of the deciding blocks, less its further prior cost. Neither has
  /// to contain the other's effects.
  double gain_over(const Scored& a, const Scored& b) const;
  /// The effect at `place` without those of its sizes that lie at a plausible bound, or whose shape does; nothing if
  /// none does or no size would be left. These sizes and their shapes are `given_up`.
  std::optional<Hypothesis> without_sizes_at_bound(const Hypothesis& h, std::size_t place,
                                                   std::vector<FitParameter>& given_up) const;
  /// True if the effect at `place` ends at its plausible bound with a size, or with a shape that acts.
  bool at_bound(const Scored& with, std::size_t place) const { return !sizes_at_bound(with, place).empty(); }
  /// True if an added effect ends at its plausible bound, so that the final fit would take back what it explains.
  bool leans_on_a_bound(const Scored& found) const;
  /// Cost of a fit: -ln L on the fitting blocks plus the prior cost of the baseline parameters.
  double cost(const Scored& scored) const;
  /// Prior cost of the refitted baseline parameters.
  double prior_cost(const Hypothesis& h) const;

 private:
  bool explains_a_rest(const Score& before, const Score& after) const;
  std::vector<std::size_t> sizes_at_bound(const Scored& with, std::size_t place) const;
  bool acts(const Scored& with, const FitParameter& shape) const;
  bool acts_in_the_whole_motion(const Scored& with, const std::vector<FitParameter>& parameters,
                                const ParameterGroup& group) const;
  bool lasts_as_long_as_the_motion(const Scored& with, const std::vector<FitParameter>& parameters,
                                   const ParameterGroup& group) const;
  bool is_as_good_at_bound(const Scored& with, const FitParameter& p) const;
  bool within_tolerance(const Hypothesis& h, std::size_t place) const;
  /// What the effects so far may miss, see misfits().
  struct FoundMisfits {
    std::vector<std::vector<double>> all;
    std::vector<std::vector<double>> elsewhere;  ///< of those that do not act in the candidate's cable
  };
  FoundMisfits misfits_beside(const Scored& without, const PlacedEffect& candidate) const;
  bool takes_a_share(const Score& before, const Score& after, const FoundMisfits& misfits, int channel) const;
  bool matters(const Scored& without, const Scored& with, std::size_t place) const;

  const Evidence& evidence_;
  const ArmModel& model_;
  std::vector<FitParameter> numbers_;
};

}  // namespace halyard

#pragma once
/// Whether an effect that was fitted explains something.
///
///   gain = Σ_b (ln L_b with the effect - ln L_b without)     likelihood.h, on the deciding blocks
///          + stretch without - stretch with
///   stretch = ½ Σ ((θ - nominal) / (tolerance / 2))²         what the refit of the baseline's numbers costs
///
/// An effect is named if
///
/// - its gain is significant, with the number of candidates respected (false_discovery.h): by a paired t test over
///   blocks; or, where it explains nearly all of a rest, by the likelihood ratio on data that the fit did not see,
///   p = 2 min(p of t, exp(-Σ_b Δ ln L_b)): a force during two of sixty blocks is not lost among blocks that it never
///   touched. This is after the split likelihood ratio of Wasserman, Ramdas and Balakrishnan, PNAS 117 (2020), and an
///   approximation: their bound asks for the largest likelihood without the effect on the deciding data, here both were
///   fitted on the others. Its size is what the blind trials of clean arms measure;
/// - it matters: a residual shrinks by more than what the model's tolerance and the sensors leave open;
/// - no parameter ends at the end of what is plausible, and does something there; nor lies a shape within twice of it
///   where the likelihood is the same.

#include "diagnosis/fit.h"
#include "diagnosis/likelihood.h"

namespace halyard {

/// An effect has to take this share of a channel's first mean square: less is the misfit of another
/// effect's functional form, which is told as an unexplained rest and not chased.
inline constexpr double kMattersShare = 0.05;
/// What an effect does to some signal has to be this many times the floor of its channel.
inline constexpr double kMattersFactor = 1.5;
/// What one number more gains in log-likelihood by chance: two standard deviations.
inline constexpr double kByChance = 2;
/// A candidate whose quick look is less significant than this is not fitted whole, nor judged any further.
inline constexpr double kWorthAFit = 0.05;

/// A candidate as it was judged.
struct Trial {
  PlacedEffect effect;
  std::vector<double> past;  ///< of Hypothesis, of this effect
  bool promising = true;     ///< false: where it takes most of the residual it takes too little to be fitted
  bool is_fitted = true;     ///< it was among those that leave least
  bool usable = false;       ///< it could be integrated
  double gain = 0;           ///< on the deciding blocks, above the baseline of its round
  double p_value = 1;        ///< of no gain, as if it were the only candidate
  bool is_judged() const { return usable && p_value <= kWorthAFit; }
  // Of one that is_judged():
  bool at_bound = false;
  bool is_refit = false;  ///< its sizes stay within the model's tolerance
  bool matters = false;
  Likelihood log_likelihood;
};

Trial unusable(const PlacedEffect& effect);

/// A hypothesis with how it scores.
struct Scored {
  Hypothesis hypothesis;
  Score score;
};

/// [2n] Channels in which what is left matters: on the deciding blocks it is well above the channel's floor.
std::vector<bool> significant_rest(const Evidence& evidence, const Score& score);

/// a - b, row by row; as long as each other.
std::vector<double> difference(std::vector<double> a, const std::vector<double>& b);

class Judge {
 public:
  /// numbers: baseline numbers that the data can tell something of. first: mean squares [2n] before any effect.
  Judge(const Evidence& evidence, const ArmModel& model, std::vector<FitParameter> numbers, std::vector<double> first);

  /// The last effect of `with` against the hypothesis without it.
  Trial trial(const Hypothesis& with, const Scored& without, const PlacedEffect& effect) const;
  /// The same of an effect amid others, at `place`: false if it is not needed.
  bool is_needed(const Scored& with, const Scored& without, int place, double significance) const;

  /// What a fit weighs, of a score: -ln L on the fitting blocks and the stretch of the baseline's numbers.
  double cost(const Scored& scored) const;

 private:
  double p_of_gain(const Score& with, const Score& without) const;
  bool explains_a_rest(const Score& before, const Score& after) const;
  bool at_bound(const Scored& with, int place) const;
  bool is_as_good_at_bound(const Scored& with, const FitParameter& p) const;
  bool within_tolerance(const Hypothesis& h, int place) const;
  bool matters(const Score& before, const Score& after, const Hypothesis& with, int place) const;
  double stretch(const Hypothesis& h) const;

  const Evidence& evidence_;
  const ArmModel& model_;
  std::vector<FitParameter> numbers_;
  std::vector<double> first_;
};

}  // namespace halyard

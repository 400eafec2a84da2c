#pragma once
/// Which effects explain the residual: candidates are fitted beside the baseline's numbers on the
/// fitting blocks and judged on the deciding ones, one after another until none helps significantly.
///
///   ln L_b = -1/2 Σ_c n_bc/m ln(MSE_bc + floor_c²)       score of deciding block b
///   gain   = Σ_b (ln L_b with the candidate - ln L_b without), and what it saves in stretching the baseline's
///            numbers: ½ Σ ((θ - nominal) / (tolerance / 2))² without minus with
///
///   n_bc, MSE_bc   rows of channel c in block b, their mean square
///   m              rows that are worth one independent sample
///
/// Each block has its own variance: no single block can carry or spoil a verdict.
///
/// A candidate is named if
///
/// - its gain is significant, with the number of candidates respected: by a paired t test over blocks; or, where it
///   explains nearly all of a rest, by the likelihood ratio itself, p <= exp(-gain), which holds on data that the fit
///   did not see (Wasserman, Ramdas and Balakrishnan, PNAS 117 (2020), split likelihood ratio): a force during two of
///   sixty blocks is not lost among blocks that it never touched;
/// - it matters: a residual shrinks by more than what the model's tolerance and the sensors leave open;
/// - no parameter ends at the end of what is plausible, and does something there; nor lies a shape within twice of it
///   where the likelihood is the same.

#include <functional>
#include <string>

#include "diagnosis/fit.h"

namespace halyard {

/// An effect has to take this share of a channel's first mean square: less is the misfit of another
/// effect's functional form, which is told as an unexplained rest and not chased.
inline constexpr double kMattersShare = 0.05;
/// What an effect does to some signal has to be this many times the floor of its channel.
inline constexpr double kMattersFactor = 1.5;
/// Two candidates whose gains differ by less than this many standard errors cannot be told apart.
inline constexpr double kTellApart = 2.0;

/// Two candidates are alternatives if of what the lesser gains the other gains so much as well: those that gain
/// elsewhere stand beside each other.
inline constexpr double kSharedGain = 0.5;

/// ln L, [deciding block][channel].
using Likelihood = std::vector<std::vector<double>>;

/// A candidate as it was judged.
struct Trial {
  PlacedEffect effect;
  bool promising = true;         ///< false: where it takes most of the residual it takes too little to be fitted
  bool usable = false;           ///< it could be fitted
  bool at_bound = false;
  bool is_refit = false;         ///< its sizes stay within the model's tolerance
  bool matters = false;
  double gain = 0;               ///< on the deciding blocks, above the baseline of its round
  double p_value = 1;            ///< of no gain
  Likelihood log_likelihood;
};

/// One round of the search: all candidates against the same baseline.
struct Round {
  std::vector<Trial> trials;     ///< best first
  bool accepted = false;         ///< the first one was added
};

struct Attribution {
  Fit baseline;                              ///< numbers refitted within their tolerance, no effect
  Fit final_fit;                             ///< with the effects that were named
  std::vector<std::vector<PlacedEffect>> alternatives;   ///< for each effect of final_fit
  std::vector<Round> rounds;
  Score nominal_score, baseline_score, final_score;
};

/// Every effect of the library wherever the arm can have it, at its typical size, in a fixed order.
std::vector<PlacedEffect> all_candidates(const ArmParameters<double>& arm);

/// a - b, row by row; as long as each other.
std::vector<double> difference(std::vector<double> a, const std::vector<double>& b);

/// [2n] Channels in which what is left matters: on the deciding blocks it is well above the channel's floor.
std::vector<bool> significant_rest(const Evidence& evidence, const Score& score);

struct AttributionOptions {
  int most_effects = 6;
  double significance = 0.01;    ///< of a round, over all its candidates
};

/// progress(text, fraction): what is being done, how far.
Attribution attribute(const Evidence& evidence, const ArmModel& model, const AttributionOptions& options,
                      const std::function<void(const std::string&, double)>& progress);

}  // namespace halyard

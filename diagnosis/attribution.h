#pragma once
/// Which effects explain the residual: candidates are fitted beside the baseline's numbers on the
/// fitting blocks and judged on the deciding ones (judge.h), one after another until none helps significantly;
/// then each is tried for removal.

#include <functional>
#include <string>

#include "diagnosis/judge.h"

namespace halyard {

/// Two candidates whose gains differ by less than this many standard errors cannot be told apart.
inline constexpr double kTellApart = 2.0;

/// Two candidates are alternatives if of what the lesser gains the other gains so much as well: those that gain
/// elsewhere stand beside each other.
inline constexpr double kSharedGain = 0.5;

/// So many candidates are fitted in a round: those that leave least of the residual where their search sets out.
inline constexpr std::size_t kMostFitted = 16;

/// One round of the search: all candidates against the same baseline.
struct Round {
  std::vector<Trial> trials;  ///< the one that was added, then by the gain of a quick look
  bool accepted = false;      ///< the first one was added
};

struct Attribution {
  Fit baseline;                                         ///< numbers refitted within their tolerance, no effect
  Fit final_fit;                                        ///< with the effects that were named
  std::vector<std::vector<PlacedEffect>> alternatives;  ///< for each effect of final_fit
  std::vector<Round> rounds;
  Score nominal_score, baseline_score, final_score;
};

/// Every effect of the library wherever the arm can have it, at its typical size, in a fixed order.
std::vector<PlacedEffect> all_candidates(const ArmParameters<double>& arm);

struct AttributionOptions {
  int most_effects = 6;
  double significance = 0.01;  ///< of a round: the expected share of candidates without a gain among those found so
};

/// progress(text, fraction): what is being done, how far.
Attribution attribute(const Evidence& evidence, const ArmModel& model, const AttributionOptions& options,
                      const std::function<void(const std::string&, double)>& progress);

}  // namespace halyard

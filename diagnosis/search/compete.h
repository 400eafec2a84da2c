#pragma once
/// A round of the search: candidates compete for one name.

#include "diagnosis/round/candidate_round.h"
#include "diagnosis/search/attribution.h"
#include "diagnosis/search/basis.h"

namespace halyard {

/// All candidates but those of which the motion has too few periods (has_enough_periods()), and those which `h` has
/// already, except pushes, slips and ripples, of which a joint may have several.
std::vector<PlacedEffect> candidates_beside(const Evidence& evidence, const Hypothesis& h,
                                            const ArmParameters<double>& arm);

/// A name for whose place candidates compete: the effect with index `place` in `found`.
struct Standing {
  const Found& found;
  std::size_t place;
};

/// The effect that a round names.
struct Won {
  Fit fit;
  Naming naming;
  PlacedEffect effect;
  bool is_standing = false;  ///< it is the standing name, with the fit that this has
};

struct RoundOutcome {
  Round told;
  std::optional<Won> won;
  double no_effect = 0;  ///< its weight if no candidate has won
};

/// The candidates compete for the place after the effects of `without`, or for that of `standing`. The standing name
/// then competes with the fit that it has, unless its fit in this round costs (Judge::cost()) less by `worth_a_change`
/// of decision_rule.h.
RoundOutcome compete(const Evidence& evidence, const Basis& basis, double significance, CandidateRound& round,
                     const Scored& without, const std::vector<PlacedEffect>& candidates,
                     const std::optional<Standing>& standing);

}  // namespace halyard

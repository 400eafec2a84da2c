#pragma once
/// A round of the search: candidates compete for one name.

#include "diagnosis/round/candidate_round.h"
#include "diagnosis/search/attribution.h"
#include "diagnosis/search/basis.h"

namespace halyard {

/// All candidates but those of which the arm has one already: a joint may have several pushes, slips, and ripples of
/// several orders.
std::vector<PlacedEffect> candidates_beside(const Hypothesis& h, const ArmParameters<double>& arm);

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
};

struct RoundOutcome {
  Round told;
  std::optional<Won> won;
  double no_effect = 0;  ///< its weight if no candidate has won
};

/// The candidates compete for the place after the effects of `without`, or for that of `standing`. Then a name that
/// wins its own place again comes with its present fit, unless its fit in this round is better.
RoundOutcome compete(const Evidence& evidence, const Basis& basis, double significance, CandidateRound& round,
                     const Scored& without, const std::vector<PlacedEffect>& candidates,
                     const std::optional<Standing>& standing);

}  // namespace halyard

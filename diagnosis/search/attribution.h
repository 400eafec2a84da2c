#pragma once
/// Finds the effects that explain the residual. In each round, candidates are fitted together with the baseline's
/// parameters on the fitting blocks and judged on the deciding blocks (judge.h). The best is added, until none helps
/// significantly. When none helps alone, a few are tried together (joint_proposal.h). Then the names are revised,
/// except the last one if it has won a round beside all the others. After that, the removal of each added effect is
/// tried. At last, each name, and then every two names at one joint, compete with pairs of other effects
/// (pair_rivals.h). If wider tolerances of the model are more probable, with the same names or fewer, the search goes
/// on with them (basis.h).

#include <functional>
#include <optional>
#include <string>

#include "diagnosis/search/naming.h"

namespace halyard {

/// One round of the search: all candidates against the same hypothesis, several effects at once, or other tolerances.
struct Round {
  /// The candidate that has won first, then in the order of the gain of their quick fits.
  std::vector<Trial> trials;
  bool accepted = false;  ///< the first trial was added; of several at once: all were
  bool at_once = false;   ///< the trials are of effects that were proposed together, each beside the others
  /// The name for whose place the candidates compete; nothing before all names are found.
  std::optional<PlacedEffect> revised = {};
  bool name_stays = false;  ///< of a revision: the name and its earlier fit are kept
  /// No candidates competed: from here on the tolerances of the model count so many times, and these names are gone.
  std::optional<double> tolerance_factor = {};
  std::vector<PlacedEffect> gone = {};
};

struct Attribution {
  Fit baseline;                 ///< parameters refitted within their tolerance, no effects
  Fit final_fit;                ///< with the effects that were found
  std::vector<Naming> namings;  ///< for each effect of final_fit that the model did not come with
  double no_effect = 1;         ///< weight of "no effect" in the last round that should add one and did not
  std::vector<Round> rounds;
  Score nominal_score, baseline_score, final_score;
  double tolerance_factor = 1;  ///< the tolerances of the model counted so many times, see basis.h
};

/// Every effect of the library at every place where the arm can have it, at its typical size, in a fixed order.
std::vector<PlacedEffect> all_candidates(const ArmParameters<double>& arm);

struct AttributionOptions {
  int most_effects = 6;
  double significance = 0.01;  ///< of a round: expected share of false candidates among the significant ones
};

/// progress(text, fraction): name of the current stage and its completed fraction.
Attribution attribute(const Evidence& evidence, const ArmModel& model, const AttributionOptions& options,
                      const std::function<void(const std::string&, double)>& progress);

}  // namespace halyard

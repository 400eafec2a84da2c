#pragma once
/// Several effects at once. An effect that explains little alone, because others that are still missing act as noise,
/// may be certain beside them. At the end of a round without a convincing candidate:
///
/// 1. a small set is selected among the candidates to first order (sparse_selection.h), on the fitting blocks;
/// 2. the whole set is fitted together with the model's parameters;
/// 3. it is pruned: each effect has to pass all tests of a single one (judge.h), beside the others of the set, with its
///    significance divided by their number. Of those that fail, the one that gains least is removed, until none fails;
/// 4. the set is convincing if it is significant as a whole against the hypothesis without it. A single effect that is
///    left has failed in the round, from a start of its own: its significance is divided by the number of candidates.
///
/// Steps 3 and 4 use the deciding blocks, which the selection and the fits have not seen. The choice of what is removed
/// in step 3 uses them, too, so the p values of what is left are approximate.

#include "diagnosis/judgement/judge.h"
#include "diagnosis/round/refit.h"
#include "diagnosis/starts/starts.h"

namespace halyard {

/// What a round knows to first order around the hypothesis from which its candidates start.
struct LinearRound {
  Hypothesis from;
  std::vector<FitParameter> numbers;         ///< of the model, that no effect so far changes
  std::vector<std::vector<double>> columns;  ///< sensitivities to them
  std::vector<Start> starts;                 ///< of each candidate
};

struct JointProposal {
  Fit fit;
  Score score;
  std::vector<Trial> trials;  ///< of each effect that was added, beside the others; in the order of the hypothesis
  bool is_convincing = false;
};

class JointSearch {
 public:
  /// given: number of effects that the model came with.
  JointSearch(const Evidence& evidence, const Refitter& refitter, const Judge& judge, std::size_t given)
      : evidence_(evidence), refitter_(refitter), judge_(judge), given_(given) {}

  /// The hypothesis of the round with the selected effects at the sizes that the linear fit gives them. Without any if
  /// nothing is worth its numbers.
  Hypothesis select(const LinearRound& round, int most) const;
  /// Steps 1 to 4, with at most so many effects; without: the hypothesis against which the set is judged.
  JointProposal propose(const LinearRound& round, const Scored& without, double significance, int most) const;

 private:
  /// A trial of each effect from `first` on, beside the others, and the fits without it.
  std::vector<Trial> trials(const JointProposal& p, std::size_t first, std::vector<Fit>& without) const;

  const Evidence& evidence_;
  const Refitter& refitter_;
  const Judge& judge_;
  std::size_t given_;
};

}  // namespace halyard

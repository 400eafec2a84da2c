#pragma once
/// A basis: the model with `factor` times its tolerances, and the fits and the judge that use them. How far a model is
/// off is itself uncertain. If its tolerances are too narrow, the search would find one effect for each number beyond
/// them. Therefore wider tolerances, with the same names or fewer, compete with those that the model states:
///
///   ln p = Σ_b ln L_b - Σ_i u_i²/2 - ½ ln det(1 + Jᵀ J) - Σ_e (cost_e + ln m) - cost of wider tolerances
///
///   ln L_b   of the deciding blocks, likelihood.h        u   numbers of the model, in half tolerances
///   J        sensitivities to them, weighted by the noise, per half tolerance             [fitting rows x numbers]
///   cost_e   prior_cost_of() each name                   m   number of candidates of which it was chosen
///
/// Source: after Laplace's approximation of the evidence, MacKay, Neural Computation 4 (1992) 415-447, section 3. ln L
/// is that of blocks which no fit has used, as everywhere in the search, and so effects need no determinant. Numbers
/// need one: twice the tolerances make each place within them half as probable.

#include <limits>
#include <memory>

#include "diagnosis/judgement/judge.h"
#include "diagnosis/round/refit.h"

namespace halyard {

/// The same model with `factor` times its tolerances. A torque scale of which nothing is known stays unknown.
ArmModel with_tolerances_times(double factor, ArmModel model);

/// A fitted hypothesis.
struct Found {
  Fit fit;
  Score score;
  Scored scored() const { return {fit.hypothesis, score}; }
};

class Basis {
 public:
  /// given: number of effects that the model came with. Check refitter.is_usable().
  Basis(const Evidence& evidence, const ArmModel& stated, double factor, std::size_t given);
  Basis(const Basis&) = delete;
  Basis& operator=(const Basis&) = delete;

  /// All passes of a fit; `before` gives the first weights.
  Found refitted(const Hypothesis& h, const Score& before) const;
  /// refitted() without each of the added effects, side by side. Where the loss after the first pass is at least
  /// `enough` nats, the fit ends there, and the score is not finite.
  std::vector<Found> without_each(const Found& found, double enough = std::numeric_limits<double>::infinity()) const;
  /// True if at least two numbers are at the end of their tolerance (is_at_bound()) or replaced by a name.
  bool is_narrow(const Hypothesis& h) const;
  /// What the prior takes from ln p, see above. Infinite if a sensitivity cannot be computed.
  double prior_cost(const Found& found) const;

  const double factor;
  const ArmModel model;
  const Refitter refitter;
  const Judge judge;

 private:
  const Evidence& evidence_;
  std::size_t given_;
};

/// Another basis, and what is left of the names on it.
struct Rebased {
  std::unique_ptr<const Basis> basis;
  Found baseline;  ///< without added effects
  Found found;
  std::vector<std::size_t> kept;   ///< indices of its names among those before
  std::vector<PlacedEffect> gone;  ///< the others
};

/// `found` on another basis of the model as stated, without the names that are not needed there; nothing if it is more
/// probable on its own basis.
std::optional<Rebased> rebased(const Evidence& evidence, const ArmModel& stated, double factor, const Basis& own,
                               const Found& found);

}  // namespace halyard

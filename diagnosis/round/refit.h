#pragma once
/// Fits a hypothesis together with the parameters of the model, in passes: each pass weighs the channels by the
/// residual that the last one left. While this is large, a pass predicts on a coarser grid (Evidence::coarse_around()).

#include <limits>
#include <optional>
#include <vector>

#include "diagnosis/fit/fit.h"
#include "diagnosis/judgement/judge.h"

namespace halyard {

/// A fit in progress.
struct Refit {
  Hypothesis at;
  Score score;  ///< of `at`; before the first pass: of the hypothesis that gives the first weights
  Fit best = {};
  double last = std::numeric_limits<double>::infinity();  ///< Σ ln of the mean squares after the last pass
  bool settled = false;
  bool is_nudged = true;                ///< before each pass
  std::vector<FitParameter> held = {};  ///< parameters of effects that are not fitted
  std::size_t nudged_from = 0;          ///< effects before this one are not nudged
};

/// The refit from another start, of which nothing is known yet.
Refit restarted(Refit refit, const Hypothesis& at);

class Refitter {
 public:
  /// Keeps the parameters of the model that the data are sensitive to: their whole tolerance moves a channel by at
  /// least a tenth of its floor. given: number of effects that the model came with. Check is_usable().
  Refitter(const Evidence& evidence, const ArmModel& model, std::size_t given);

  /// False if the model cannot be integrated along the record.
  bool is_usable() const { return usable_; }
  const ArmParameters<double>& nominal() const { return model_.nominal; }
  /// Number of effects that the model came with.
  std::size_t given() const { return given_; }
  /// The parameters of the model that the data are sensitive to.
  const std::vector<FitParameter>& numbers() const { return numbers_; }

  /// Parameters of the model that no effect of the hypothesis changes. Beside an added effect by which a cable yields
  /// (yields_in_the_cable()), its stiffness and damping are among them, whether or not the data are sensitive to them
  /// without it: the damping of a stiff cable does not show, that of a soft one does.
  std::vector<FitParameter> numbers_beside(const Hypothesis& h) const;
  /// These, then the past of its effects and the parameters of the added effects.
  std::vector<FitParameter> parameters(const Hypothesis& h) const;
  /// The hypothesis with one more effect. Parameters of the model that this effect changes are reset.
  Hypothesis with_effect(Hypothesis h, const PlacedEffect& effect, const std::vector<double>& past = {}) const;

  /// Runs passes until one no longer helps, but at most `passes` of them.
  void go_on(Refit& refit, int passes) const;
  /// Runs all passes, starting from h. `before` is the score that gives the first weights.
  Fit refit(const Hypothesis& h, const Score& before) const;
  /// The hypothesis after refit(), with its score; nothing if it cannot be integrated.
  std::optional<Scored> refitted(const Hypothesis& h, const Score& before) const;

 private:
  /// A number of a cable to which the data are not sensitive.
  struct OfCable {
    FitParameter number;
    int joint;
  };
  bool may_show(const OfCable& hidden, const Hypothesis& h) const;

  const Evidence& evidence_;
  const ArmModel& model_;
  std::size_t given_;
  std::vector<FitParameter> numbers_;
  std::vector<OfCable> hidden_;
  bool usable_ = false;
};

}  // namespace halyard

#pragma once
/// What effects would do to the residual of a model in a motion: the sizes from which a diagnosis detects and names
/// them. The conditions and the terms are those of diagnosis/plan.h.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "diagnosis/fit/baseline_reach.h"
#include "diagnosis/fit/fit_parameter.h"
#include "diagnosis/plan.h"
#include "diagnosis/planning/change_detector.h"

namespace halyard {

/// All segments of these logs. Throws InputError if one cannot be compared with the model.
std::vector<Record> planned_records(const ArmModel& model, const std::vector<Log>& logs);

class Planner {
 public:
  /// Throws InputError for logs that cannot be compared with the model.
  Planner(const ArmModel& model, const std::vector<Log>& logs);

  /// Effects that the model does not have already.
  const std::vector<PlacedEffect>& candidates() const { return candidates_; }

  /// The model with an effect of growing size: at a factor of 0 it is neutral. Factors beyond `largest` count as that.
  struct Growing {
    std::function<Hypothesis(double)> at;
    double largest = 0;
  };
  /// One linear combination of an effect's sizes that may explain a residual.
  struct Fitted {
    BaselineReach::Sizes sizes;
    std::vector<bool> bound_is_end;  ///< [sizes] an amount at its bound explains nothing
  };
  /// What a candidate may do, in the reach's weights.
  struct Shown {
    DetectionLimit limit;
    Growing growing;             ///< in typical sizes
    double seen_from = 0;        ///< the factor at the limit; infinite if there is none
    Eigen::VectorXd change;      ///< d at twice the limit; of an effect that is not excited nothing
    std::vector<Fitted> fitted;  ///< one for each set of shapes; sizes to be fitted
  };
  /// The candidate with its detection limit.
  Shown show(const PlacedEffect& candidate) const;
  /// The effect with all its sizes scaled together, from their neutral values; at a factor of 1 they are as given.
  Growing scaled(const PlacedEffect& effect) const;
  /// False for an effect with a shape that no search tries in this motion, for example an order of too few periods.
  bool is_searched(const PlacedEffect& effect) const;

  /// The smallest factor at which the effect is detected; infinite if there is none.
  double detected_from(const Growing& effect) const;
  /// The smallest factor from `seen_from` on at which none of the others is confused with the effect; infinite if there
  /// is none. Effects that are not confused with it at `seen_from` are not confused at larger sizes either.
  double named_from(const Growing& effect, double seen_from, const std::vector<const Shown*>& others) const;

  /// True if the other effect explains this change of the residual nearly as well as the effect that caused it.
  bool confused(const Eigen::VectorXd& change, const Shown& other) const;
  /// See Separation::cosine; one way.
  double cosine(const Shown& right, const Shown& other) const;

 private:
  /// The model with an effect, and the parameters of this effect.
  struct Placed {
    Hypothesis with;
    std::vector<FitParameter> parameters;
  };
  struct SizedCandidate;
  Placed beside_nominal(const PlacedEffect& effect) const;
  SizedCandidate sized(const PlacedEffect& candidate) const;
  BaselineReach make_reach();
  Hypothesis best_shapes(const SizedCandidate& c, Shown& shown, std::vector<Eigen::VectorXd>& columns) const;
  /// d of each hypothesis; empty if it cannot be integrated.
  std::vector<Eigen::VectorXd> changes_by(const std::vector<Hypothesis>& hypotheses) const;
  void add_fitted(Shown& shown, const std::vector<Eigen::VectorXd>& columns, const std::vector<double>& unit,
                  const SizedCandidate& c) const;
  /// The smallest factor whose change is accepted, to 9 %; infinite if there is none up to the largest. `first` is
  /// tried first, then larger ones, and smaller ones if `first` is accepted.
  double smallest(const Growing& effect, double first,
                  const std::function<bool(const Eigen::VectorXd&)>& accepts) const;

  const ArmModel& model_;
  Hypothesis nominal_;
  Evidence evidence_;
  std::vector<double> base_;  ///< fitting rows of the model as it is
  BaselineReach reach_;
  std::vector<PlacedEffect> candidates_;
  Eigen::VectorXd residual_;  ///< r0
  std::optional<ChangeDetector> detector_;
};

}  // namespace halyard

#pragma once
/// The numbers that an identification estimates, with their priors.

#include <string>
#include <vector>

#include "estimators/identification/dual_ukf.h"

namespace halyard {

/// What is estimated, in this order: the numbers asked for; zeros of encoders, if unknown; the model's other numbers.
/// The dual filter learns the first two kinds. Prior deviations: 30 % of a coupling and 50 % of another number that is
/// asked for, on a logarithmic scale unless it may have either sign; half the tolerance of a number that is not.
struct Unknowns {
  std::vector<Weight> weights;
  std::vector<double> reach;  ///< tolerances of those asked for, in their units
  Eigen::Index asked = 0, learnt = 0;

  Eigen::Index count() const { return static_cast<Eigen::Index>(weights.size()); }
  std::vector<Weight> learnt_weights() const { return {weights.begin(), weights.begin() + learnt}; }
  /// How far each may be from the model, in prior deviations; infinity for the learnt ones. A number that the model
  /// knows within a tolerance keeps at least a quarter of its value, since a cable that pushes is no cable, and moves
  /// by at most ten tolerances: beyond, it stands for something else that the model lacks.
  Eigen::VectorXd bound() const;
};

/// keys: see identified_keys().
Unknowns list_unknowns(const ArmModel& model, const std::vector<std::string>& keys);

/// True if each log has zeros of encoders of its own.
bool has_unknown_zeros(const ArmModel& model);

}  // namespace halyard

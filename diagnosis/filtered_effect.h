#pragma once
/// Effects as a record shows them. Motion and torque of a record went through one Gaussian filter (record.h). A torque
/// that is periodic in the motor's angle, n periods a turn, alternates faster the faster the motor turns, and the filter
/// leaves that much less of it:
///
///   τ' = τ exp(-(n q_m' σ)² / 2)
///
///   τ    what the effect adds to the motor's torque        N m
///   n    its order, a parameter of the effect               -
///   σ    standard deviation of the filter                   s
///
/// What changes slowly against the filter is shown as it is.

#include <memory>
#include <vector>

#include "transmission/effect.h"

namespace halyard {

/// The effects of an arm, each as it is or, if its torque is periodic (SearchSpace::order_of_motor_torque), filtered.
/// The effects have to outlive it.
class FilteredEffects {
 public:
  FilteredEffects(const std::vector<PlacedEffect>& effects, const ArmParameters<double>& arm, double sigma_s);

  const Effect* operator[](std::size_t i) const { return seen_[i]; }

 private:
  std::vector<std::unique_ptr<const Effect>> owned_;
  std::vector<const Effect*> seen_;
};

}  // namespace halyard

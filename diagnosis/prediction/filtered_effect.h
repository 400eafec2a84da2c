#pragma once
/// Effects after the filter of a record. Motion and torque of a record are filtered by one Gaussian kernel (record.h).
/// For a torque that is periodic in the motor's angle, with n periods per turn, the frequency grows with the motor's
/// speed, and the filter attenuates it:
///
///   τ' = τ exp(-(n q_m' σ)² / 2)
///
///   τ    motor torque added by the effect                  N m
///   n    its order, a parameter of the effect               -
///   σ    standard deviation of the filter                   s
///
/// Slow changes pass the filter unchanged.

#include <memory>
#include <vector>

#include "transmission/effect.h"

namespace halyard {

/// The effects of an arm; those with a periodic torque (SearchSpace::order_of_motor_torque) are filtered.
/// The effects must outlive this object.
class FilteredEffects {
 public:
  FilteredEffects(const std::vector<PlacedEffect>& effects, const ArmParameters<double>& arm, double sigma_s);

  const Effect* operator[](std::size_t i) const { return seen_[i]; }

 private:
  std::vector<std::unique_ptr<const Effect>> owned_;
  std::vector<const Effect*> seen_;
};

}  // namespace halyard

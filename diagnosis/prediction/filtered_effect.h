#pragma once
/// Effects after the filter of a record. Motion, torque and joint readings of a record are filtered by one Gaussian
/// kernel (record.h). The frequency of a torque that is periodic in the motor's angle, or of a joint sensor's error
/// that is periodic in the joint's position, grows with the speed, and the filter attenuates it:
///
///   τ' = τ exp(-(n q_m' σ)² / 2)        e' = e exp(-(k q' σ)² / 2)
///
///   τ    motor torque added by the effect                                 N m
///   e    error of the joint's reading added by the effect                 rad | m
///   n    periods per turn of the motor, a parameter of the effect         -
///   k    its phase per position of the joint, a parameter of the effect   - | rad/m
///   σ    standard deviation of the filter                                 s
///
/// Slow changes pass the filter unchanged.

#include <memory>
#include <vector>

#include "transmission/effect.h"

namespace halyard {

/// The effects of an arm; those with a periodic torque (SearchSpace::order_of_motor_torque) or a periodic error of a
/// joint sensor (SearchSpace::order_of_joint_position) are filtered. The effects must outlive this object.
class FilteredEffects {
 public:
  /// sigma_s: of the motor's torque, and of the joint's readings; 0: not filtered.
  FilteredEffects(const std::vector<PlacedEffect>& effects, const ArmParameters<double>& arm, double sigma_s,
                  double joint_sigma_s);

  const Effect* operator[](std::size_t i) const { return seen_[i]; }

 private:
  std::vector<std::unique_ptr<const Effect>> owned_;
  std::vector<const Effect*> seen_;
};

}  // namespace halyard

#pragma once
/// Ripples of a motor's torque repeat with its angle, so they are no noise of the sensors. In a moving motor they
/// spread over the same frequencies as noise, and are removed before the noise is estimated.
///
///   minimise over a_m, b_m   Σ (e - Σ_m (a_m cos mθ + b_m sin mθ))²,   m = first, ..., kHighestOrder
///
///   e   torque residual, N m        θ   motor angle, rad
///
/// `first` is the lowest order that passes 1.5 periods along the motion: lower ones cannot be told from slow errors of
/// the model.

#include <vector>

namespace halyard {

inline constexpr int kHighestOrder = 48;  ///< pole pairs, slots and commutator bars have no more

/// The residual without what goes with the angle; one run for each record. NaN stay and do not count. Unchanged if the
/// motor passes no order.
std::vector<std::vector<double>> ripple_free(std::vector<std::vector<double>> residual,
                                             const std::vector<std::vector<double>>& motor_angle);

}  // namespace halyard

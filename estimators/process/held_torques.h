#pragma once
/// How uncertain a motor's torque becomes while it is held for want of a newer command, as in a gap of a log.
///
/// A command holds over its period, so it is known there. From one and a half of the usual periods after it on, it is
/// taken for a random walk τ' = s w, with the intensity of the record's own commands so far:
///
///   s² = Σ Δτ² / Σ Δt        usual period = Σ Δt / (number of changes)
///
/// A change over more than ten usual periods does not count: the commands in between are missing.
///
/// From a to b after that instant the walk gives the rotor an impulse whose variance is that of a white torque of the
/// density s² t²:
///
///   ∫ s² t² dt = s² (b³ - a³) / 3        (N m s)²
///
/// Over a whole gap this is exactly the variance of the walk's impulse.

#include <array>

#include "transmission/arm_parameters.h"

namespace halyard {

class HeldTorques {
 public:
  /// The command of a motor from time_s on, N m; NaN: the last one is held. Earlier times than the last do not count.
  void take(int motor, double time_s, double torque);
  /// Variance of the unknown impulse of a motor over from_s to to_s, (N m s)².
  double impulse_variance(int motor, double from_s, double to_s) const;

 private:
  struct Motor {
    double torque = 0, time_s = 0;  // of the last command
    double squares = 0, span_s = 0;
    long changes = 0;
    bool is_known = false;

    double usual_period_s() const { return span_s / static_cast<double>(changes); }
  };
  std::array<Motor, kMaxJoints> motors_;
};

}  // namespace halyard

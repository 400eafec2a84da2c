#pragma once
/// How much an effect shows in a log, beyond what the model's own tolerances, constant errors of the sensors and another
/// past of the effect could explain.
///
///   d        change of the predicted residuals by the effect, each channel over its floor     [rows]
///   d⊥       d - J u - c - P v,  u, c, v = argmin |d - J u - c - P v|² / m + |u|²
///   strength max over channels of the root mean square of d⊥
///
///   c        a constant of each channel: an encoder's zero, a torque's bias; 0 for effects that are such errors
///   J        sensitivities to the model's numbers, in halves of their tolerance, over the floor  [rows x numbers]
///   P        changes of d by the effect's past, see Hypothesis                               [rows x states]
///   m        rows that are worth one independent sample
///
/// At strength 1 the effect is as large as what the sensors resolve, or 1 % of the torque.

#include <Eigen/QR>

#include "diagnosis/fit/evidence.h"
#include "model/arm_model.h"

namespace halyard::blind {

class StrengthMeter {
 public:
  StrengthMeter(const Log& training, const ArmModel& model);

  /// Infinite if the effect is so large that its motion cannot be predicted.
  double strength(const PlacedEffect& effect) const;

 private:
  /// A channel's mean taken off each of its rows.
  void take_off_constants(Eigen::Ref<Eigen::VectorXd> rows) const;

  Evidence evidence_;
  Hypothesis nominal_;
  std::vector<double> base_;
  /// J and the rows of |u|²; in `centred` without the channels' constants.
  struct Reach {
    Eigen::MatrixXd J;
    Eigen::HouseholderQR<Eigen::MatrixXd> qr;
  } whole_, centred_;
};

}  // namespace halyard::blind

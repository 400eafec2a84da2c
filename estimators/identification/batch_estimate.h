#pragma once
/// The batch estimate of an identification: damped Gauss-Newton steps over the blocks of the logs (see identify.h).
///
/// A step is taken in full unless the arm with these numbers cannot be integrated, or explains the logs worse:
///
///   cost(u) = Σ ( ½ νᵀ S⁻¹ ν / s² + log |S_root| ) + ½ |u|²,   with s of the step's start
///
/// It is halved in these cases. Source: Nocedal and Wright, "Numerical optimization", 2nd ed., chapters 3 and 10.
///
/// A filter whose process noise is larger than the log's disturbances follows the noise of the encoders, and its
/// prediction is then a regression on noisy numbers, which biases stiffness and damping. So the steps are repeated with
/// a smaller process noise as long as one explains the innovations better where the last steps ended: with the factors
/// 0.3, 0.1, 0.03, while each lowers the cost with s = 1, which is the likelihood (Ljung, "System identification", 2nd
/// ed., chapter 7.4).

#include <functional>
#include <vector>

#include "estimators/identification/block_jackknife.h"
#include "estimators/identification/unknowns.h"
#include "model/log.h"

namespace halyard {

/// Where the steps end.
struct BatchEstimate {
  JackknifeEstimate estimate;
  bool converged = false;  ///< the last step moved no number asked for by more than a fifth of its standard deviation
  double innovation_size = 1;  ///< s: RMS of the innovations, in standard deviations of the filter, but at least 1
  double disturbances = 1;     ///< the factor of the filter's process noise
};

/// Starts at the dual filter's estimate `learnt_u` [unknowns.learnt], limited to three prior deviations, or at
/// the model where the arm cannot be integrated there. progress(pass, fraction), passes from 1.
/// Throws std::runtime_error if the arm cannot be integrated with the model's numbers.
BatchEstimate estimate_from_blocks(const ArmModel& model, const Unknowns& unknowns, const std::vector<Log>& logs,
                                   const Eigen::VectorXd& learnt_u, const std::function<void(int, double)>& progress);

}  // namespace halyard

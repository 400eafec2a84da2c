#pragma once
/// Identifies parameters of an arm from logs with joint sensors: first the dual filter of dual_ukf.h runs over the log;
/// then a batch estimate, started at the filter's result, gives values and 95 % intervals.
///
/// The dual filter assumes that innovations are independent. Residuals of a real arm are correlated: encoders at rest
/// are rounded, torque errors last for a while, and errors of other parameters are permanent. So the filter runs over
/// the log again with weights held at u. The weights are the requested parameters and every other parameter for which
/// the model states a tolerance. Centres of mass and inertias of links are taken as exact. The least-squares sums are
/// taken over blocks b of the log. The Gauss-Newton step for u is repeated until u of the requested parameters
/// converges:
///
///   A_b = Σ Yᵀ S⁻¹ Y / s²,   g_b = Σ Yᵀ S⁻¹ ν / s²,   A = Σ A_b + I,   u ← u + A⁻¹ (Σ g_b - u)
///   s² = max(1, mean of νᵀ S⁻¹ ν per reading)
///
/// With s², a filter that assumes too little noise does not take its innovations for knowledge of the parameters (the
/// variance of unit weight of least squares). If it assumes too much, the process noise is made smaller, and the steps
/// are damped (batch_estimate.h).
///
/// Y must be the derivative of the predicted readings (dual_ukf.h). If Y is too large, A is too large as well. The
/// iteration then stops before Σ g_b = u, and the intervals are too narrow.
///
/// The variance of u has two parts. The first is the variance of the estimates u_-b, each of which leaves out one block
/// (block jackknife). An error that is constant within a block therefore counts only once. The second is the remaining
/// influence of the prior u ~ N(0, I):
///
///   var(u) = max( (B-1)/B Σ_b (u_-b - mean)² + |rows of A⁻¹|²,  diag A⁻¹ )
///
/// Intervals use Student's t with B - 1 degrees of freedom. The filter's own covariance A⁻¹ is a lower bound. It is
/// needed where the disturbances are smaller than the filter assumes: rounding errors of encoders do not average out,
/// and blocks then agree better with each other than with the truth. (The study in docs/identification.md has 50 logs.
/// In 11 of them, disturbances were below a quarter of what the filter assumes: there the jackknife interval alone
/// contained the coupling C01 in 8 logs. In the other 39 logs, the jackknife interval alone contained C01 in 38.)
///
/// The other parameters are estimated too, with half their tolerance as prior standard deviation. This keeps the
/// requested parameters unbiased and their intervals wide enough, for example when a cable's stiffness is wrong by its
/// tolerance. The model keeps its values of the other parameters.
///
/// Sources: Ljung, "System identification", 2nd ed., chapters 7 and 9; Künsch, "The jackknife and the bootstrap for
/// general stationary observations", Annals of Statistics 17 (1989).

#include <functional>
#include <string>
#include <vector>

#include "estimators/identification/dual_ukf.h"
#include "estimators/identification/identified_keys.h"
#include "model/log.h"

namespace halyard {

enum class Convergence {
  converged,
  drifting,    ///< in the last third of the logs the filter's estimate moved by at least a tenth of its
               ///< tolerance and at least three of its standard deviations
  not_excited  ///< the interval is not much narrower than that of the prior
};

struct IdentifiedNumber {
  std::string key, name, unit;
  int joint = 0;       ///< 0-based
  double nominal = 0;  ///< in the model as given
  double value = 0;
  double lower = 0, upper = 0;  ///< 95 % interval
  Convergence convergence = Convergence::converged;
  std::vector<double> trace;  ///< the dual filter's estimate over Identification::time
  /// Standard deviation of that estimate. In the filter's standard deviation, the part that comes from the data is
  /// multiplied by a factor: the final standard deviation of `value`, divided by that of the filter at the end. The
  /// part that comes from the prior is unchanged.
  std::vector<double> trace_std;
};

/// A parameter that was not requested, but whose estimate is far from the model.
struct DeviatingNumber {
  std::string name, unit;
  double nominal = 0, value = 0;
  double tolerances = 0;  ///< value - nominal, in tolerances
};

struct Identification {
  std::vector<IdentifiedNumber> numbers;
  std::vector<DeviatingNumber> deviating;  ///< significantly beyond twice their tolerance
  std::vector<double> time;                ///< s, of the logs joined end to end
  int blocks = 0;
  bool converged = false;  ///< the last pass moved no parameter by more than a fifth of its standard deviation
  /// RMS of the innovations at the estimate, in standard deviations of the filter; at least 1.
  double innovation_size = 1;
  /// Process noise of the estimate over what the filters assume: 1, 0.3, 0.1 or 0.03, as the log asks for it
  /// (batch_estimate.h).
  double disturbances = 1;
  std::string filter_failure;  ///< why the dual filter ended before the logs did; empty: it did not
  ArmModel model;              ///< with the identified values
};

/// Identifies the parameters `keys`. progress(text, fraction) is called repeatedly.
/// Throws InputError if a log is shorter than 3 s, if it lacks the sensor of a joint with a requested parameter, or if
/// there are several logs and encoders with unknown zero, or if the arm cannot be integrated over the logs.
Identification identify(const ArmModel& model, const std::vector<Log>& logs, const std::vector<std::string>& keys,
                        const std::function<void(const std::string&, double)>& progress = {});

}  // namespace halyard

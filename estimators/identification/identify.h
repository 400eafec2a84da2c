#pragma once
/// Numbers of an arm from a log with joint sensors: the dual filter of dual_ukf.h over the log, then an estimate with
/// an honest interval around where it ended.
///
/// The filter takes the innovation of each sample as new. Residuals of a real arm are not: encoders that are rounded at
/// rest, torques that are wrong for a while, other numbers of the model that are wrong for good. So, weights held at u,
/// the filter runs over the log again, with two kinds of weights: those asked for, and every other number of the model
/// that it states a tolerance of. The innovations' least squares are summed up by blocks b of the log,
///
///   A_b = Σ Yᵀ S⁻¹ Y,   g_b = Σ Yᵀ S⁻¹ ν,   A = Σ A_b + I,   u ← u + A⁻¹ (Σ g_b - u)          (Gauss and Newton)
///
/// until u of the numbers asked for stands. Y has to be the innovations' derivative: where it is too large, so is A,
/// steps end short of Σ g_b = u, and intervals are too narrow. The variance of u is that of estimates u_-b that leave
/// out one block each, so that whatever is alike within a block is counted once (a block jackknife), and of what is
/// left of the prior u ~ N(0, I):
///
///   var(u) = max( (B-1)/B Σ_b (u_-b - mean)² + |rows of A⁻¹|²,  diag A⁻¹ )
///
/// with intervals by Student's t of B - 1. A⁻¹, the filter's own word, is a floor: where the arm is quieter than the
/// noise that the filter assumes, blocks agree better with each other than with the truth, because rounded encoders are
/// no noise that averages out. (In 50 logs of docs/identification.md's study the jackknife alone held C01 38 times of
/// 39, but 8 times of 11 where disturbances were below a quarter of what the filter assumes.) That u of the other
/// numbers is estimated along, within half its tolerance as a standard deviation, makes the numbers asked for right,
/// and their intervals wide enough, where a cable's stiffness is off by its tolerance. The other numbers themselves are
/// left as they are in the model.
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
  drifting,    ///< the filter's estimate moved in the last third of the logs, by a tenth of its
               ///< tolerance and three of the filter's deviations or more
  not_excited  ///< the interval is not much narrower than what was known before
};

struct IdentifiedNumber {
  std::string key, name, unit;
  int joint = 0;       ///< 0-based
  double nominal = 0;  ///< in the model as given
  double value = 0;
  double lower = 0, upper = 0;  ///< 95 %
  Convergence convergence = Convergence::converged;
  std::vector<double> trace;      ///< of the dual filter, over Identification::time
  std::vector<double> trace_std;  ///< its deviation, widened as the interval is
};

/// A number that was not to be identified, but whose estimate lies far from the model.
struct DeviatingNumber {
  std::string name, unit;
  double nominal = 0, value = 0;
  double tolerances = 0;  ///< by how many of its tolerances, signed
};

struct Identification {
  std::vector<IdentifiedNumber> numbers;
  std::vector<DeviatingNumber> deviating;  ///< beyond twice their tolerance, significantly
  std::vector<double> time;                ///< s of the logs one after the other
  int blocks = 0;
  bool converged = false;  ///< the last pass moved no number by more than a fifth of its deviation
  ArmModel model;          ///< with the numbers
};

/// progress(text, fraction) is called now and then.
/// Throws InputError if a log has no sensor of a joint whose number is asked for, is shorter than 3 s, or if encoders
/// of unknown zero are to be found from several logs.
Identification identify(const ArmModel& model, const std::vector<Log>& logs, const std::vector<std::string>& keys,
                        const std::function<void(const std::string&, double)>& progress = {});

}  // namespace halyard

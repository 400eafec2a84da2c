#pragma once
/// How well estimators that get motor signals alone know the joints on logs that were held out.

#include <string>
#include <vector>

#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

/// Errors of one estimator on the hold-out against the joints' sensors. [n]; NaN without a sensor.
struct EstimatorErrors {
  std::vector<double> rms, peak;  ///< empty if it failed
  std::vector<double> time;       ///< s, of what follows: all logs one after another
  Signals innovation;             ///< [motor] over its predicted deviation, ~ N(0, 1) if the model is right; NaN: none
  Signals joint_rate;             ///< [n] as estimated
  double mean_nis = 0;            ///< of its innovations, ~ 1 if the model is right; 0: it has none
  std::string failure;            ///< why it failed
};
/// A log, and the time from which its errors count: an estimator remembers what was before, as a cable does.
struct HeldOutLog {
  const Log* log;
  double from;
};
/// The errors over all logs together, of runs in processes of their own. A load that was measured is no part of the
/// model, and is handed on as to the prediction.
EstimatorErrors errors_of(const std::string& estimator, const ArmModel& model, const std::vector<HeldOutLog>& logs);

struct EstimatorComparison {
  std::string name;
  EstimatorErrors before, after;  ///< with the given and with the revised model
};

}  // namespace halyard

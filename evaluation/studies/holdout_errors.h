#pragma once
/// Errors of estimators without joint sensors, on held-out logs.

#include <string>
#include <vector>

#include "evaluation/run/contained_run.h"
#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

/// Errors of one estimator on the hold-out against the joint sensors, [n]; NaN without a sensor.
struct EstimatorErrors {
  std::vector<double> rms, peak;  ///< empty if it failed
  std::vector<double> time;       ///< s, of the signals below: all logs joined end to end
  /// [motor] divided by its predicted standard deviation, ~ N(0, 1) if the model is right; NaN: none
  Signals innovation;
  Signals joint_rate;   ///< [n] estimated, rad/s | m/s
  double mean_nis = 0;  ///< mean of νᵀ S⁻¹ ν / m, ~ 1 if the model is right; NaN: no innovations
  std::string failure;  ///< why it failed
};
/// A log, and the time in s from which its errors count. The samples before that time let the estimator's state settle.
struct HeldOutLog {
  const Log* log;
  double from;
};
/// The errors over all logs together. The estimator gets motor signals, and measured external loads, because these are
/// not part of the model (the diagnosis' prediction gets them too). It gets no joint sensors.
EstimatorErrors errors_of(const std::string& estimator, const ArmModel& model, const std::vector<HeldOutLog>& logs,
                          const ContainmentOptions& containment = {});

struct EstimatorComparison {
  std::string name;
  EstimatorErrors before, after;  ///< with the given model and with the revised model
};

}  // namespace halyard

#pragma once

#include "evaluation/run/estimate.h"
#include "model/arm_model.h"

namespace halyard {

/// Predicted readings of the joint sensors: q̂ plus the model's sensor errors (offset, eccentricity, delay). Estimates
/// are compared with sensors in this form, so that known sensor errors do not count as errors of the estimate. NaN
/// where there is no estimate.   [n][samples], rad | m
Signals sensor_readings(const ArmModel& model, const EstimatorRun& run);

}  // namespace halyard

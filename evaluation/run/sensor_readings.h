#pragma once

#include "evaluation/run/estimate.h"
#include "model/arm_model.h"

namespace halyard {

/// What the joints' sensors would read if the estimates were true: q̂ + the errors that the model says the sensors make
/// (offset, eccentricity, delay). Estimates are judged by sensors through this, so that a sensor that lags is no fault
/// of an estimate. NaN where there is no estimate.   [n][samples], rad | m
Signals sensor_readings(const ArmModel& model, const EstimatorRun& run);

}  // namespace halyard

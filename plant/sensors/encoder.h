#pragma once
/// Encoders: reading = truth + sensor error (Transmission::sensor_errors()), rounded to the resolution. Noise is
/// not added here: the caller adds it to the sensor errors before, as simulate() does.

#include <Eigen/Core>

#include "plant/drive_train.h"

namespace halyard {

struct Readings {
  Eigen::VectorXd motor;  ///< [n] rad; 0 at a joint without a motor
  Eigen::VectorXd joint;  ///< [n] rad | m
};

/// Readings of the encoders from the signals of all joints; a resolution of 0 means no rounding.
Readings read_encoders(const ArmParameters<double>& arm, const JointSignals<double>* s, bool quantise);

}  // namespace halyard

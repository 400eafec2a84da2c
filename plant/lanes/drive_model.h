#pragma once
/// What the kernels of the plant compute with.

#include <optional>

#include "plant/lanes/plant_layout.h"
#include "transmission/transmission.h"

namespace halyard {

/// A plain drive train: cables of one law drive all joints, and no effect acts between the commands and the joints.
/// What happens at one joint is then independent of the other joints, so all joints are evaluated at once, lane k for
/// joint k.
struct PlainDrive {
  JointParameters<Lanes> joint;  ///< lanes beyond the last joint repeat it
  Lanes travel;                  ///< r_m / N, m/rad
};

/// The drive train over the scalars of rates and slopes, and its present inputs.
struct DriveModel {
  Transmission<double> transmission;
  Transmission<Dual> dual;
  std::optional<PlainDrive> plain;
  PlantLayout layout;
  CommandHistory history;
  double command[kMaxJoints] = {}, external[kMaxJoints] = {};
};

/// A state at one instant.
struct PlantInstant {
  double time;
  const double *q, *v, *z;
};

}  // namespace halyard

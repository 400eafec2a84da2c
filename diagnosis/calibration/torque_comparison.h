#pragma once
/// Recorded torques next to those that the motion requires according to the model.

#include "diagnosis/record/record.h"

namespace halyard {

/// Band-limited torques of each motor, [n][samples of all records]. needed is NaN where the motor does not move or the
/// torque cannot be compared. Both are NaN where a record lacks the torque.
struct TorqueComparison {
  Signals recorded;  ///< N m
  Signals needed;    ///< over the model's torque scale, N m
  double step = 0;   ///< s between samples
  /// False: the arm cannot be integrated along the motion of a record, whose `needed` is NaN then.
  bool is_predicted = true;
};
/// Adds the samples of `more`, with the step of `all`, behind its own.
void append(TorqueComparison& all, const TorqueComparison& more);

TorqueComparison compare_torques(const ArmModel& model, const std::vector<Record>& records);

}  // namespace halyard

#pragma once
/// What a motion limits: where instants and positions can lie, how fast is near standstill, and of which orders the
/// motion has enough periods.

#include <vector>

#include "diagnosis/record/record.h"

namespace halyard {

struct MotionRange {
  struct Range {
    double from = 0, to = 0;
  };
  Range record;                 ///< s
  std::vector<Range> joint;     ///< [n] rad | m
  std::vector<double> fastest;  ///< [n] speed of the joint, rad/s | m/s
};

/// Of the records of a log, by the motors' readings, as if no cable were stretched.
MotionRange motion_range(const std::vector<Record>& records, const ArmParameters<double>& arm);

}  // namespace halyard

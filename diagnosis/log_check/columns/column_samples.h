#pragma once
/// What a single column shows: runs of equal samples, and jumps.

#include <string>
#include <vector>

#include "diagnosis/log_check/log_under_check.h"

namespace halyard {

/// The samples that a column has.
struct Samples {
  std::vector<double> time, x;
  Samples(const Log& log, const std::vector<double>& column);
  std::size_t size() const { return x.size(); }
};

/// Samples begin..end-1 that are equal.
struct Run {
  std::size_t begin, end;
  std::size_t size() const { return end - begin; }
};
std::vector<Run> runs_of(const std::vector<double>& x);

/// Samples for which a reading usually keeps its value: a slow sensor repeats the last one. At least one run.
double usual_length(const std::vector<Run>& runs);

/// A motor's or a joint's position.
struct PositionColumn : ColumnPlace {
  double resolution;
  double significant;  ///< motion that counts as such, unit of the column
  bool turns;          ///< an angle
};
/// Those that the log has, of driven motors and of all joints.
std::vector<PositionColumn> position_columns(const LogUnderCheck& c);

/// How to do without wrong samples of a position. A log needs the position of every motor.
std::string leave_out(const PositionColumn& column);

/// Steps between two samples that no motion explains and that stay.
struct Jumps {
  std::size_t count = 0;
  double step = 0, when = 0;  ///< of the first
  double usual = 0;           ///< 99th percentile of the steps
  bool alike = true;          ///< all of the same size

  /// "jumps by 0.64 between two samples at 1 s, the first of 2 jumps"
  std::string description() const;
};
Jumps jumps_of(const LogUnderCheck& c, const PositionColumn& column);

}  // namespace halyard

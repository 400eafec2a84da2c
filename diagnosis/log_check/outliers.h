#pragma once
/// Single wrong readings of a sensor: a lost bit, a bad pose of a camera, a disturbed cable. The diagnosis leaves them
/// out, because one of them acts on a filtered residual like a push.
///
/// A line is fitted to the two readings before and the two after one to three readings: along their times, because rows
/// may be lost, and another one along their numbers, because a logger may write even readings at uneven times. Those
/// between are outliers if
///
///   min |d| >= factor · u      and      max |r| <= min |d| / 5
///
///   d   distances of the readings between from the nearer line
///   r   distances of the four readings from the line that fits them better
///   u   usual distance of a reading from its neighbours: a robust standard deviation of the column
///
/// The second condition keeps steps, reversals and vibrations: after them the column does not go on as before. Two or
/// three readings are outliers only if they last less than 5 ms, within which no motor leads a joint away and back.

#include <cstddef>
#include <vector>

#include "model/log.h"

namespace halyard {

struct Outliers {
  std::vector<std::size_t> rows;  ///< of the log; a slow sensor repeats a reading in several rows
  std::size_t readings = 0;
  double largest = 0;  ///< distance of the worst from its line, with its sign
  double when = 0;     ///< its time, s
  double usual = 0;    ///< u
};

/// What counts as one.
struct OutlierRule {
  /// factor. Gaussian noise reaches 6 once in 10^9 samples.
  double factor = 10;
  /// Least min |d| of a torque, as a share of the width of its central 98 %. The currents of real drives have short
  /// peaks far above their noise, and below this share they do no harm.
  double torque_share = 0.5;
};

/// time, column [n_rows]; NaN is a missing sample. A reading that is repeated until the next counts once. Readings with
/// |d| below `least` are none.
Outliers find_outliers(const std::vector<double>& time, const std::vector<double>& column, double factor,
                       double least = 0);
Outliers find_torque_outliers(const Log& log, int k, const OutlierRule& rule);

/// The log with empty cells where a motor's position, a motor's torque or a joint's position is an outlier. A torque is
/// also left out as far around an outlier as the motion's filter reaches (record.h): the peak may have been real, and
/// then the motion contains its effect.
Log without_outliers(Log log, const OutlierRule& rule = {});

}  // namespace halyard

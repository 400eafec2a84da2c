#pragma once
/// Work and precision of the plant's integrators on a RAVEN-II whose first link's cable is stiffer, and whose friction
/// is sharper, than the model's:
///
///   stiffness    factor of stiffness and damping of link 1's cable
///   smoothing    factor of all smoothing speeds of friction
///   resting      false: sines of all joints; true: the arm is held, under noise of the torques that friction carries
///   error        largest difference of a joint's position from the reference (bdf), rad | m
///   work         processor time of the thread for each simulated second, ms

#include <string>
#include <vector>

#include "model/log.h"
#include "plant/scenario.h"

namespace halyard {

/// A run that takes longer than this, in s, is the last one of its integrator in its case.
inline constexpr double kLongestRun = 2;

struct StiffCase {
  double stiffness = 1, smoothing = 1;
  bool resting = false;
};

struct WorkPoint {
  double error = 0, work_ms = 0;
};

struct WorkPrecision {
  std::string integrator;
  std::vector<WorkPoint> points;  ///< from the loosest tolerance on; ends where a run fails or takes too long
};

/// Names of all integrators but the reference, as scenario files have them.
std::vector<std::string> compared_integrators();

Scenario scenario_of(const StiffCase& which, double duration_s);
/// The truth of the scenario on halyard's own chain, by bdf with tight tolerances.
Log reference(Scenario scenario);
/// Of a joint's position; never below what rounding leaves.
double largest_difference(const Log& a, const Log& b);

/// duration_s: simulated time of each run.
std::vector<WorkPrecision> measure(const StiffCase& which, double duration_s);

/// Work at this error, between points on straight lines of the logarithms; that of the first point if it is more exact.
/// NaN if no point is exact enough.
double work_at(const WorkPrecision& integrator, double error);

}  // namespace halyard

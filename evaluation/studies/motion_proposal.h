#pragma once
/// Proposes a motion that tells two effects apart. A seeded random search simulates the arm, with its controller and
/// torque limits, in several motions and chooses the one with the smallest Separation::cosine of the two effects.
///
/// Each joint moves within its range in one of two ways:
///
///   sines   two or three; the slowest has 0.1 to 0.8 Hz, and each next one is 1.3 to 4 times as fast
///   moves   of 0.3 to 3 s each, between three to six points, with rests of up to 1 s
///
/// A motion is considered only if the detection limits of both effects are at most twice those in the given motion.

#include <functional>
#include <optional>
#include <string>

#include "diagnosis/plan.h"
#include "plant/scenario.h"

namespace halyard {

struct SeparatingMotion {
  PlacedEffect first, second;
  Separation given;                  ///< in the given motion
  std::optional<Scenario> scenario;  ///< the proposed one; none: no motion that was tried is better than the given one
  Separation proposed;
  Log log;        ///< of the proposed scenario
  int tried = 0;  ///< number of motions
};

/// The scenario as a plan simulates it: with a robot as the model says, and with encoders.
Scenario planned_scenario(Scenario scenario, const ArmModel& model);

/// Simulates the scenario and returns its log, without joint positions if joint_sensor is false.
Log planned_log(const Scenario& scenario, bool joint_sensor, const std::function<void(double)>& progress = {});

/// The i-th random motion of the given scenario's robot, with the scenario's duration. A joint without a controller
/// does what it does in the scenario.
Scenario random_motion(const Scenario& given, int i);

/// Searches for a motion that tells the two effects apart. given_log: of the given scenario. progress(what, fraction)
/// is called repeatedly.
SeparatingMotion separating_motion(const Scenario& given, const Log& given_log, const PlacedEffect& first,
                                   const PlacedEffect& second, bool joint_sensor,
                                   const std::function<void(const std::string&, double)>& progress);

}  // namespace halyard

#pragma once
/// A motion that tells two effects apart, by a seeded random search: of some motions that the arm is simulated in, so
/// that its controller and torque limits count, the one in which the two look least alike.
///
///   each joint, within its range:  two or three sines, the slowest of 0.1 to 0.8 Hz, the next 1.3 to 4 times as fast,
///   or
///                                  moves of 0.3 to 3 s between three to six points with rests of up to 1 s
///
/// Alike is Separation::cosine. Motions count in which both effects are seen from at most twice the size on from which
/// the given motion shows them.

#include <functional>
#include <optional>
#include <string>

#include "diagnosis/plan.h"
#include "plant/scenario.h"

namespace halyard {

struct SeparatingMotion {
  PlacedEffect first, second;
  Separation given;                  ///< in the given motion
  std::optional<Scenario> scenario;  ///< none: no motion that was tried is better than the given one
  Separation proposed;
  Log log;  ///< of the proposed scenario
  int tried = 0;
};

/// A log of the scenario as the plan sees it: joint positions left out if there is no sensor.
Log planned_log(const Scenario& scenario, bool joint_sensor, const std::function<void(double)>& progress = {});

/// The i-th motion of the family, as long as the given scenario's; of its robot.
Scenario random_motion(const Scenario& given, int i);

/// given_log: of the given scenario. progress as in detection_limits().
SeparatingMotion separating_motion(const Scenario& given, const Log& given_log, const PlacedEffect& first,
                                   const PlacedEffect& second, bool joint_sensor,
                                   const std::function<void(const std::string&, double)>& progress);

/// A proposed scenario as a scenario file; model is its model attribute.
std::string proposal_xml(const Scenario& scenario, const std::string& model);

}  // namespace halyard

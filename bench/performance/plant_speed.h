#pragma once
/// How much faster than real time the plant runs under control at 1 kHz, with default options.

#include <string>
#include <vector>

namespace halyard {

struct PlantSpeed {
  std::string name;      ///< of the case
  double own_chain = 0;  ///< simulated time over processor time, on halyard's own chain
  double simbody = 0;    ///< on Simbody
  double own_error = 0;  ///< largest difference of a joint's position from `bdf` with tight tolerances, rad | m
  double simbody_error = 0;
};

/// The RAVEN-II moving and at rest, with a cable of link 1 a hundred times as stiff and damped, with friction that is
/// ten times as sharp, and under a noise of the torques that friction carries. The two engines take turns, and the best
/// of some runs counts.
std::vector<PlantSpeed> time_plant(double duration_s);

}  // namespace halyard

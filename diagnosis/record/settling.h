#pragma once
/// How long the arm swings on its cables after a start that is not known exactly.

#include "model/arm_model.h"

namespace halyard {

/// Time after which the slowest swing of the joints about held motors is a seventh (e⁻²) of itself, s; at least `least`
/// and at most 3 s. At home, without the joints' Coulomb friction, which stops a swing at rest, but not in motion.
double settling_time(const ArmModel& model, double least);

}  // namespace halyard

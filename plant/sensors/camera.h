#pragma once
/// What a camera writes into a log: the marker at the tool as it was a latency ago, in the rows in which frames arrive.

#include <random>

#include "model/log.h"
#include "plant/arm_plant.h"
#include "plant/scenario.h"

namespace halyard {

/// Adds the marker's columns to `measured`, from the true motion of the joints, linear between its rows. Frame j
/// arrives in the first row at or after j / rate; those exposed before the record are not there.
void add_camera(const Camera& camera, const double* point, const Log& truth, std::uint64_t seed, ArmPlant& plant,
                Log& measured);

}  // namespace halyard

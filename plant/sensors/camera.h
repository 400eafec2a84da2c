#pragma once
/// The camera's columns of a log: where the marker at the tool was one latency earlier, in the rows in which frames
/// arrive.

#include <random>

#include "model/log.h"
#include "plant/arm_plant.h"
#include "plant/scenario.h"

namespace halyard {

/// Adds the marker's columns to `measured`. The marker follows the true motion of the joints, linear between the rows
/// of `truth`. Frame j arrives in the first row at or after j / rate. Frames exposed before the record starts are
/// omitted. point: [3] in the last link's frame, m.
void add_camera(const Camera& camera, const double* point, const Log& truth, std::uint64_t seed, ArmPlant& plant,
                Log& measured);

}  // namespace halyard

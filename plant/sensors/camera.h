#pragma once
/// The camera's columns of a log: the position that the marker at the tool had one latency earlier. Only the rows in
/// which a frame arrives have a value.

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

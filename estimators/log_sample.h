#pragma once
/// Rows of a log as an estimator's input.

#include <cstddef>

#include "estimators/estimator.h"
#include "model/log.h"

namespace halyard {

/// Sets the sample's time, torques, motor positions and marker to those of row i; its load stays. Cells that are empty
/// become NaN; a joint whose motor has no column gets the torque NaN and the position 0. No marker: empty.
void read_row(const Log& log, std::size_t i, Sample& sample);

/// Row i without a load.
Sample sample_of(const Log& log, std::size_t i);

}  // namespace halyard

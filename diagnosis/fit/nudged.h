#pragma once
/// Leaves shallow minima before a fit: impacts, instants and gaps make the residual a rough function of some parameters.

#include "diagnosis/fit/fit.h"

namespace halyard {

/// Changes the parameters of the effects from index `first` on, one after another. A parameter is multiplied by factors
/// from 0.1 to 10; an instant or a position is moved by up to half of the distance between two starts. Keeps each
/// change that lowers the sum of squares of the fitting rows, each channel divided by its scale.
Hypothesis nudged(const Evidence& evidence, Hypothesis h, std::size_t first, const ArmParameters<double>& nominal,
                  const std::vector<double>& scale);

}  // namespace halyard

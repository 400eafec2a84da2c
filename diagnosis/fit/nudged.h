#pragma once
/// Leaves shallow minima before a fit: impacts, instants and gaps make the residual a rough function of some parameters.

#include "diagnosis/fit/beyond_numbers.h"

namespace halyard {

struct Nudge {
  Hypothesis at;
  double gain = 0;  ///< in log-likelihood: half of what is left less
};

/// Changes the parameters of the effects from index `first` on, one after another. A parameter is multiplied by factors
/// from 0.1 to 10; an instant or a position is moved by up to half of the distance between two starts. Keeps each
/// change that lowers what the model's numbers cannot explain: at fixed numbers a stiffer hysteresis would have to be
/// kept as soft as the number of the stiffness is stiff.
Nudge nudged(const Evidence& evidence, Hypothesis h, std::size_t first, const ArmParameters<double>& nominal,
             const BeyondNumbers& beyond);

}  // namespace halyard

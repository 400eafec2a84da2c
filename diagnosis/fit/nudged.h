#pragma once
/// Leaves shallow minima before a fit: impacts, instants and gaps make the residual a rough function of some
/// parameters.

#include "diagnosis/fit/beyond_numbers.h"

namespace halyard {

struct Nudge {
  Hypothesis at;
  double gain = 0;  ///< in log-likelihood: half of what is left less
};

/// Changes the parameters of the effects from index `first` on, one after another. A parameter that is always positive
/// is multiplied by factors from 0.1 to 10, and so is one that cannot be negative, if its bounds are not those of
/// nature. A whole number is moved by one or two; an instant or a position is moved by up to half of the distance
/// between two starts, unless it is a whole number, which means that it is given. Other parameters stay: they act
/// smoothly. A change is kept if it lowers the part of the residual that the model's numbers cannot explain. If the
/// numbers were fixed, a right change of a hysteresis would be refused until the stiffness of the model follows.
Nudge nudged(const Evidence& evidence, Hypothesis h, std::size_t first, const ArmParameters<double>& nominal,
             const BeyondNumbers& beyond);

}  // namespace halyard

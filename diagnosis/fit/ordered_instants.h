#pragma once
/// A force F from t_1 to t_2 is the force -F from t_2 to t_1: a fit may end at either. The latter reads like an error.

#include "diagnosis/fit/fit_parameter.h"

namespace halyard {

/// The same prediction: where the two instants of a size are in the wrong order among the fitted parameters, they are
/// exchanged, and the size has the other sign.
Hypothesis with_ordered_instants(Hypothesis h, const std::vector<FitParameter>& parameters);

}  // namespace halyard

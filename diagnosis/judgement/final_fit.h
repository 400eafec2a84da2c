#pragma once
/// The last fit of a diagnosis: on all training data, with the parameters that these data determine.

#include "diagnosis/fit/fit.h"

namespace halyard {

/// Fits the parameters of `chosen` again on `whole`, an Evidence without deciding blocks. Then parameters that did not
/// change significantly are reset, one at a time, the least certain first, and the others are fitted again. A number of
/// the model is reset to its own value, also if its change moves no channel by its floor. A size of an effect is reset
/// to its neutral value. If the data determine only a combination of two parameters, one of them keeps its change. An
/// effect all of whose sizes are reset has no parameter in the result.
/// given: number of effects that the model came with; they stay.
Fit final_fit(const Evidence& whole, const ArmModel& model, const Fit& chosen, std::size_t given);

/// Effects, as indices in the hypothesis, of which no size is left in the fit.
std::vector<std::size_t> idle_effects(const Fit& fit, std::size_t given);

/// Half of the 95 % interval over the standard deviation: Student's quantile for the fit's blocks.
double interval_factor(const Fit& fit);

/// True if the refitted number of the model differs from it significantly.
bool is_refit(const Fit& fit, std::size_t parameter);

}  // namespace halyard

#pragma once
/// What a diagnosis could not have found in its data.

#include <vector>

#include "diagnosis/diagnose.h"
#include "diagnosis/fit/evidence.h"

namespace halyard {

/// Effects whose typical size, beside the hypothesis `at`, changes no signal by more than its floor; and periodic ones
/// of which the motion has too few periods (has_enough_periods()).
std::vector<NotExcited> not_excited(const Evidence& evidence, const Hypothesis& at, const ArmParameters<double>& arm);

}  // namespace halyard

#pragma once
/// What a diagnosis says, in the words of a result.

#include "bench/diagnosis/draw/hidden.h"
#include "diagnosis/diagnose.h"

namespace halyard::blind {

/// Verdict, names, probabilities and hold-out errors. robot: the truth.
void take_over(const Diagnosis& d, const ArmModel& robot, Result& r);

}  // namespace halyard::blind

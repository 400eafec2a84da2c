#pragma once
/// What a diagnosis says, in the words of a result.

#include "bench/diagnosis/results/result.h"
#include "bench/diagnosis/trial/recording.h"
#include "diagnosis/diagnose.h"

namespace halyard::blind {

/// Verdict, names, probabilities, hold-out errors, and how many samples of the hold-out its intervals contain.
void take_over(const Diagnosis& d, const Recording& recording, Result& r);

}  // namespace halyard::blind

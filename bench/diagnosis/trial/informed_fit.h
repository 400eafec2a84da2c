#pragma once
/// The model that a fit finds which knows what a diagnosis has to find out: which effects the arm has, and near which
/// values. It tells what the training log can teach at best: what no sensor shows, nobody can fit.

#include <optional>

#include "bench/diagnosis/trial/recording.h"

namespace halyard::blind {

/// The final fit of a diagnosis (final_fit.h) of the true effects to the training log, from their true values and from
/// the numbers of `given`, a model without effects. Nothing if the library lacks one of the effects, or if they cannot
/// be integrated along the measured motion.
std::optional<ArmModel> informed_fit(const ArmModel& given, const Recording& recording, int off);

}  // namespace halyard::blind

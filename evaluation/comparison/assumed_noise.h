#pragma once
/// The noise that the filters assume by default, in a form that a simulation can draw.

#include "model/arm_model.h"
#include "plant/scenario.h"

namespace halyard {

/// σ and τ: estimators/process/noise.h. Torques and joint forces have the spectral density 2 σ² τ and are held over a
/// tick. Encoder noise with the assumed standard deviation replaces the rounding, and the noise that the model states:
/// the robot must state none. factor: of all standard deviations.
TickNoise assumed_noise(const ArmModel& model, double tick_s, double factor = 1);

}  // namespace halyard

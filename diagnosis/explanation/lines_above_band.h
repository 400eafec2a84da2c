#pragma once
/// What the residuals contain above the frequencies that are compared: hum, a resonance, chatter. No effect of the
/// library is fitted to it.

#include <vector>

#include "diagnosis/diagnose.h"
#include "diagnosis/fit/evidence.h"

namespace halyard {

/// One sentence for each line of the channels' noise (channel_noise.h) that is larger than the floor of its channel. A
/// line that several channels show is told where it stands highest above the floor. A line that the revised model
/// explains is not told.
std::vector<Unexplained> lines_above_band(const Evidence& evidence, const Hypothesis& revised);

}  // namespace halyard

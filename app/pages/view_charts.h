#pragma once

#include <string>
#include <vector>

#include "app/report/chart.h"
#include "evaluation/studies/diagnosis_evidence.h"

namespace halyard {

/// With a capital first letter; not for empty text.
std::string capitalised(std::string text);

/// The views of a residual, one chart each, and the spectrum beside a view over an angle: without and with the effect,
/// and the curve without it. Where there is room, the loop of the transmission over load. Of a rest only the rest.
/// An effect that no view tells is drawn over time.
std::vector<report::Chart> view_charts(const EffectEvidence& evidence, const ArmParameters<double>& arm, bool is_rest);

}  // namespace halyard

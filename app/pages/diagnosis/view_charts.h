#pragma once

#include <string>
#include <vector>

#include "app/pages/diagnosis/name_text.h"
#include "app/report/chart.h"
#include "evaluation/studies/diagnosis_evidence.h"

namespace halyard {

/// One chart for each view of a residual. It shows the residual without the effect, the residual with the effect, and
/// the curve that is fitted to the residual without the effect. A view over an angle also has a spectrum. If there is
/// room, the transmission residual over load is added as a loop. An unexplained residual has one series only. Without
/// informative views the residual is drawn over time.
std::vector<report::Chart> view_charts(const EffectEvidence& evidence, const ArmParameters<double>& arm, bool is_rest);

}  // namespace halyard

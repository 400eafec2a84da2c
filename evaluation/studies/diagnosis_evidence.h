#pragma once
/// The residuals that speak for what a diagnosis found, for drawing. Not installed: they are the diagnosis' own signals.

#include <vector>

#include "diagnosis/views.h"

namespace halyard {

/// Residuals of one joint over the training data, and the two or three views that say most.
struct EffectEvidence {
  int joint = 0;                  ///< 0-based, whose residuals these are
  ResidualSignals without, with;  ///< by the revised model without the effect, and with it; the same for a rest
  std::vector<View> views;        ///< best first; empty: no view says much
};

struct DiagnosisEvidence {
  std::vector<EffectEvidence> effects;      ///< as Diagnosis::effects
  std::vector<EffectEvidence> unexplained;  ///< as Diagnosis::unexplained
};

}  // namespace halyard

#pragma once
/// Residuals that support a diagnosis, for charts. Not installed: they are internal signals of the diagnosis.

#include <vector>

#include "diagnosis/explanation/views.h"

namespace halyard {

/// Residuals of one joint over the training data, and the two or three most informative views.
struct EffectEvidence {
  int joint = 0;                  ///< 0-based joint of the residuals
  ResidualSignals without, with;  ///< of the revised model without and with the effect; equal if unexplained
  std::vector<View> views;        ///< best first; empty: no view is informative
};

struct DiagnosisEvidence {
  std::vector<EffectEvidence> effects;      ///< one for each of Diagnosis::effects
  std::vector<EffectEvidence> unexplained;  ///< one for each of Diagnosis::unexplained
};

}  // namespace halyard

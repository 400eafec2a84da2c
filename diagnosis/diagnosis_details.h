#pragma once
/// Intermediate results of a diagnosis: the search, and the models' predictions of the hold-out. For reports, studies
/// and tests of this project; the public interface is diagnose.h.

#include <vector>

#include "diagnosis/diagnose.h"
#include "diagnosis/holdout/holdout.h"
#include "diagnosis/search/attribution.h"

namespace halyard {

struct DiagnosisDetails {
  Attribution attribution;
  /// What the search and the final fit have compared. The final fit predicts these: Diagnosis::revised has its instants
  /// on the clocks of their logs.
  std::vector<Record> training;
  HoldOut joint_view;   ///< in kJointErrorBand
  HoldOut torque_view;  ///< in kFitBand
  std::vector<DiagnosisData::Late> late;
};

}  // namespace halyard

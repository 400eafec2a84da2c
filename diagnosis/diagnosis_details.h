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
  std::vector<std::vector<double>> past;  ///< Hypothesis::past of the revised model's effects, for the training records
  HoldOut joint_view;                     ///< in kJointErrorBand
  HoldOut torque_view;                    ///< in kFitBand
};

}  // namespace halyard

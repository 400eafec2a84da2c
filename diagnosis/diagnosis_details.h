#pragma once
/// Intermediate results of a diagnosis: the search, and the models' predictions of the hold-out. For reports, studies
/// and tests of this project; the public interface is diagnose.h.

#include <vector>

#include "diagnosis/diagnose.h"
#include "diagnosis/search/attribution.h"

namespace halyard {

/// Frequency band of fits and of reported torque errors. In this band the second derivative of a rounded angle is still
/// meaningful.
inline constexpr RecordOptions kFitBand = {};
/// Frequency band of reported joint errors. It includes the vibrations of the cables.
inline constexpr RecordOptions kJointErrorBand = {.motion_hz = 100, .compare_hz = 0, .settle_s = 0.5, .step_s = 0.001};

/// Records of the hold-out, and their predictions by the given (before) and the revised model (after).
struct HoldOut {
  std::vector<Record> records;
  std::vector<FullPrediction> before, after;
};

struct DiagnosisDetails {
  Attribution attribution;
  std::vector<std::vector<double>> past;  ///< Hypothesis::past of the revised model's effects, for the training records
  HoldOut joint_view;                     ///< in kJointErrorBand
  HoldOut torque_view;                    ///< in kFitBand
};

}  // namespace halyard

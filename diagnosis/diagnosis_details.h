#pragma once
/// How a diagnosis came to its result: the search, and what the models predict of the hold-out. For reports, studies and
/// tests of this project; the public interface is diagnose.h.

#include <vector>

#include "diagnosis/attribution.h"
#include "diagnosis/diagnose.h"

namespace halyard {

/// The band of the records that a diagnosis learns from, and that torques are told in: there the second derivative of a
/// rounded angle still means something.
inline constexpr RecordOptions kFitBand = {};
/// The band that errors of joints are told in: there the joints move, vibrations of the cables included.
inline constexpr RecordOptions kJointErrorBand = {.motion_hz = 100, .compare_hz = 0, .settle_s = 0.5, .step_s = 0.001};

/// Records of the hold-out and what the given and the revised model predict of them.
struct HoldOut {
  std::vector<Record> records;
  std::vector<FullPrediction> before, after;
};

struct DiagnosisDetails {
  Attribution attribution;
  std::vector<std::vector<double>> past;  ///< of the revised model's effects, before each training record: Hypothesis
  HoldOut joint_view;                     ///< in kJointErrorBand
  HoldOut torque_view;                    ///< in kFitBand
};

}  // namespace halyard

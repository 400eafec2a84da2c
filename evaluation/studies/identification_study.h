#pragma once
/// Identifies parameters of a model, and tests on held-out logs whether they improve it.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "estimators/identification/identify.h"
#include "evaluation/studies/holdout_errors.h"

namespace halyard {

/// An identification, and errors of estimators with motor signals alone, with the given and the identified model.
struct IdentificationStudy {
  ArmModel given;
  std::string data, holdout;  ///< descriptions of the logs, for reports
  Identification identification;
  std::vector<EstimatorComparison> estimators;  ///< kinematics, sr_ukf
};

/// Identifies the parameters of these keys (see identified_keys()) from the logs. Without a hold-out the last third of
/// each log is held out. progress(text, fraction) is called repeatedly.
/// Throws as identify() does. EstimatorErrors::failure reports an estimator that fails on the hold-out.
IdentificationStudy study_identification(const ArmModel& model, const std::vector<Log>& logs,
                                         const std::optional<Log>& holdout, const std::vector<std::string>& keys,
                                         const std::function<void(const std::string&, double)>& progress = {},
                                         const ContainmentOptions& containment = {});

/// True if the identified values are adopted as the model's. They are rejected if sr_ukf with them fails on the
/// hold-out. They are also rejected if a joint's RMS error grows by more than a tenth and the product of after / before
/// over all joints is above 1. Kinematics assumes rigid cables and is not used for this decision.
bool adopted(const IdentificationStudy& study);

/// Reasons to doubt the identified values, one sentence each: other parameters estimated far from the model, no
/// convergence, joints with larger errors on the hold-out, values that are not adopted. Empty if there are none.
std::vector<std::string> doubts(const IdentificationStudy& study);

}  // namespace halyard

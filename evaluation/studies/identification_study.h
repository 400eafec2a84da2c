#pragma once
/// Identifies parameters of a model, and tests on held-out logs whether they improve it.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "estimators/identification/identify.h"
#include "evaluation/studies/holdout_errors.h"

namespace halyard {

/// An identification, and the errors of estimators that get motor signals alone: once with the given model, once with
/// the identified model.
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
/// hold-out. They are also rejected if two conditions hold together: the RMS error of a joint grows by more than a
/// tenth, and the product of (RMS error after) / (RMS error before) over all joints is above 1. Kinematics assumes
/// rigid cables and is not used for this decision.
bool adopted(const IdentificationStudy& study);

/// Reasons to doubt the identified values, one sentence each: parameters that were not to be identified have estimates
/// far from the model's values; the estimate did not converge; joints have larger errors on the hold-out; the values
/// are not adopted. Empty if there are none.
std::vector<std::string> doubts(const IdentificationStudy& study);

}  // namespace halyard
